// SPDX-License-Identifier: Apache-2.0
// wedge_chains: paths over several edges, a few of each link: the chains of edges that strings between its ends touch
// when they are pulled tight over the roofs. The list grows until it holds them; a path may be in it several times.
#pragma once
#include <vector>

#include "kernel_calls/wedge_chains.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/tuning.hpp"
#include "passes/wedge_grid.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

class WedgeChains {
 public:
  // grid: over the edges of the same world as the lists of wedges. most_edges: the most of a path, at most
  // WT_MOST_EDGES. max_depth: interactions that a row has room for, at least most_edges. wavelength_m: the longest;
  // edges under a string count within its Fresnel zone.
  WedgeChains(gpu::Context& context, const WedgeGrid& grid, uint32_t most_edges, uint32_t max_depth,
              double wavelength_m);
  SolvedList& operator()(const DeviceScene& scene, const WedgeList& wedges, const RadioEnds& ends, Counters& counters);

 private:
  gpu::Context& context_;
  Work work_;
  gpu::KernelOf<calls::wedge_chains::roof_chains> roofs_;
  uint32_t most_edges_;
  double wavelength_m_;
  wt_edge_map_arguments map_;
  gpu::Buffer<uint32_t> first_, listed_;
  gpu::Buffer<double> radii_;
  gpu::Buffer<uint32_t> uprights_;
  SolvedList solved_;
};

}  // namespace wavetracer
