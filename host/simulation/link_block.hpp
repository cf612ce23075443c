// SPDX-License-Identifier: Apache-2.0
// The links of some of a frame's transmitters and receivers: their paths are the same, bit for bit, as in the whole
// frame. The rays of all ends that may find a link are needed, so these ends launch as in the whole frame.
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
  Listeners listeners;         // those of all origins, with the receivers of own links only
};

// The ends that launch in a block: those of its links, or those of all links of its transmitters, where other batches
// of receivers use what they find.
enum class Launching { own, all_receivers };

// links: all links of the frame, sorted.
LinkBlock make_link_block(const std::vector<Link>& links, TransmitterRange from, ReceiverRange to, Launching launching,
                          std::span<const uint32_t> receiver_of_transmitter,
                          std::span<const uint32_t> transmitter_of_receiver, const Origins& origins);

// The launchers of the block, in their order.
std::vector<Launcher> launchers_of(const LinkBlock& block, const std::vector<Launcher>& launchers);

}  // namespace wavetracer
