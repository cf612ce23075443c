// A frame whose receivers launch rays, a batch of receivers at a time. Each receiver keeps what its rays have found
// until its paths are known, so memory grows with their number, as in coverage maps with diffraction. What one finds
// leads to paths of its own links alone, so the frame is the same, bit for bit.
#pragma once
#include <vector>

#include "simulation/link_block.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/frame_result.hpp"

namespace wavetracer {

// One batch where the frame is not cut: receivers launch no rays or are few. Of trace.batch_receivers each, but no more
// than `most`.
std::vector<ReceiverRange> receiver_batches(const TraceConfig& trace, uint32_t receiver_count, uint32_t most = no_end);

// The frame that the batches are, one after the other. Counts and seconds are those of all work; the rays of
// transmitters are launched for every batch. Assumes two batches at least, without a cache or waypoints.
FrameResult joined_batches(std::vector<FrameResult> batches);

}  // namespace wavetracer
