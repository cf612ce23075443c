// SPDX-License-Identifier: Apache-2.0
// Figures of links and counts of a frame from the sums that the device has made (kernels/fields/link_sums.cl).
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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
// room: memory that the figures use, if it is large enough.
SummedPaths summed_paths(std::span<const device::wt_link_sum> sums, uint32_t frame, std::span<const Link> links,
                         bool told, std::vector<LinkFigures> room = {});

// Returns figures of so many links, with any values. room: as above; memory that is new is first used by all cores,
// since the system hands out its pages then, which takes longer than to write figures.
std::vector<LinkFigures> sized_figures(std::vector<LinkFigures> room, size_t links);

SumCounts sum_counts(std::span<const device::wt_link_sum> sums);

}  // namespace wavetracer
