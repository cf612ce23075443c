// The links of some of a frame's transmitters and receivers: their paths are the same, bit for bit, as in the whole
// frame. A link is found from all ends whose rays it may meet on its way, so these launch as they do in the whole
// frame.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "simulation/listeners.hpp"
#include "wavetracer/simulation.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Receivers first to end - 1.
struct ReceiverRange {
  uint32_t first = 0, end = no_end;
};

struct LinkBlock {
  std::vector<Link> own;       // between the transmitters and receivers of the block, sorted
  std::vector<Link> solved;    // own ones and their twins (finished_paths.hpp), sorted
  std::vector<char> launches;  // by origin: its rays may find a path of an own link
};

// links: all of the frame, sorted.
LinkBlock make_link_block(const std::vector<Link>& links, TransmitterRange from, ReceiverRange to,
                          std::span<const uint32_t> receiver_of_transmitter,
                          std::span<const uint32_t> transmitter_of_receiver, const Origins& origins);

// Those that launch in the block, in their order.
std::vector<Launcher> launchers_of(const LinkBlock& block, const std::vector<Launcher>& launchers);

}  // namespace wavetracer
