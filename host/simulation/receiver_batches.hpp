// SPDX-License-Identifier: Apache-2.0
// A frame whose receivers launch rays is computed in batches of receivers. The sequences that a receiver's rays have
// found are kept until its paths are known, so memory grows with the number of receivers, as in coverage maps with
// diffraction. The rays of a receiver only lead to paths of its own links, so the frame is the same, bit for bit.
#pragma once
#include <vector>

#include "simulation/link_block.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Gives one batch if the frame is not cut: receivers launch no rays or are few. Otherwise a batch has
// trace.batch_receivers receivers, or as many as the memory of the device, in bytes, can surely hold; but at most
// `most`. summed: the host reads sums of links, so the rows of a batch are needed for its time alone, and frames
// without diffraction are cut, too.
std::vector<ReceiverRange> receiver_batches(const TraceConfig& trace, uint32_t receiver_count, uint64_t memory,
                                            uint32_t most = no_end, bool summed = false);

}  // namespace wavetracer
