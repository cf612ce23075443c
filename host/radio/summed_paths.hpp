// SPDX-License-Identifier: Apache-2.0
// Figures of links and counts of a frame from the sums that the device has made (kernels/fields/link_sums.cl).
#pragma once
#include <span>

#include "wavetracer/device/field_records.h"
#include "wavetracer/link_figures.hpp"
#include "wavetracer/missed.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Counts of all paths of a frame.
struct SumCounts {
  MissedCounts missed;      // one frame
  uint32_t near_edges = 0;  // paths closer to an edge than the theory of diffraction holds
};

// sums: one for each link. told: do quarters of rays show what they have missed?
SummedPaths summed_paths(std::span<const device::wt_link_sum> sums, uint32_t frame, std::span<const Link> links,
                         bool told);

SumCounts sum_counts(std::span<const device::wt_link_sum> sums);

}  // namespace wavetracer
