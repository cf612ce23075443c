// The links of some of a frame's transmitters: their paths are the same, bit for bit, as in the whole frame.
// A link is found from all ends whose rays it may meet on its way, so these launch as they do in the whole frame.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "simulation/listeners.hpp"
#include "wavetracer/simulation.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct LinkBlock {
  TransmitterRange range;
  std::vector<Link> own;       // from the transmitters of the block, sorted
  std::vector<Link> solved;    // own ones and their twins (finished_paths.hpp), sorted
  std::vector<char> launches;  // by origin: its rays may find a path of an own link
};

// links: all of the frame, sorted.
LinkBlock make_link_block(const std::vector<Link>& links, TransmitterRange range,
                          std::span<const uint32_t> receiver_of_transmitter,
                          std::span<const uint32_t> transmitter_of_receiver, const Origins& origins);

// Those that launch in the block, in their order.
std::vector<Launcher> launchers_of(const LinkBlock& block, const std::vector<Launcher>& launchers);

}  // namespace wavetracer
