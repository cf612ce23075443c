// SPDX-License-Identifier: Apache-2.0
// The edges that may cross a line in plan: those of the static scene by the cells of a grid, those of vehicles by
// instance. It serves kernels/lib/curtain.clh. Only edges that diffract outwards count, and none that is upright.
#pragma once
#include <cstdint>
#include <vector>

#include "wavetracer/device/arguments.h"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct WedgeGrid {
  // wedges: all of a world, in the form of wedge_records; the first `static_count` do not move. The grid over those has
  // about as many cells as it lists edges, and at most 2^20. free_edges: do half planes count?
  WedgeGrid(const std::vector<wt_wedge>& wedges, uint32_t static_count, uint32_t instance_count, bool free_edges);

  wt_edge_map_arguments map{};
  std::vector<uint32_t> first;   // for each cell, row by row, then each instance: its start in `listed`; then the end
  std::vector<uint32_t> listed;  // numbers of wedges
  std::vector<double> radii_m;   // for each instance how far its edges reach from its position
  // For the start and the end of each wedge: the upright wedge that begins or ends there, within 2 mm, or WT_NONE.
  std::vector<uint32_t> uprights;
};

// Does a line of length along x and y touch the square cell of this centre and half side, or come as near as `margin`?
bool touches_cell(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& centre, double half, double margin);

}  // namespace wavetracer
