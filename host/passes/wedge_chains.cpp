// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/wedge_chains.cl.
// WT_STRINGS work-items take a pair of a transmitter and a receiver, also if it is no link.
#include "passes/wedge_chains.hpp"

#include "passes/growing_list.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

WedgeChains::WedgeChains(gpu::Context& context, const WedgeGrid& grid, uint32_t most_edges, uint32_t max_depth,
                         double wavelength_m)
    : context_(context),
      work_(tuning_of(context.info()).exact),
      roofs_(context),
      most_edges_(most_edges),
      wavelength_m_(wavelength_m),
      map_(grid.map),
      first_(context.buffer(grid.first, {"cells of edges", advice::scene})),
      listed_(context.buffer(grid.listed, {"edges of cells", advice::scene})),
      radii_(context.buffer(grid.radii_m, "reach of vehicles' edges")),
      uprights_(context.buffer(grid.uprights, {"upright edges of corners", advice::scene})) {
  solved_.max_depth = max_depth;
  solved_.deepest = most_edges;
  solved_.counter = counter_word(&wt_counters::chains);
  solved_.reserve(context, 1 << 10);
}

SolvedList& WedgeChains::operator()(const DeviceScene& scene, const WedgeList& wedges, const RadioEnds& ends,
                                    Counters& counters) {
  const auto run = [&] {
    roofs_(work_.range(size_t{WT_STRINGS} * ends.transmitter_count * ends.receiver_capacity), Stage::wedge_chains,
           calls::wedge_chains::roof_chains{
               .wedges = wedges.wedges,
               .first = first_,
               .listed = listed_,
               .radii = radii_,
               .uprights = uprights_,
               .instances = scene.exact_instances,
               .transmitters = ends.transmitters,
               .receivers = ends.receivers,
               .links = ends.links,
               .solved = solved_.headers,
               .vertices = solved_.vertices,
               .sequences = solved_.sequences,
               .counters = counters.buffer(),
               .args = wt_wedge_chains_arguments{.map = map_,
                                                 .wavelength_m = wavelength_m_,
                                                 .transmitter_count = ends.transmitter_count,
                                                 .receiver_capacity = ends.receiver_capacity,
                                                 .most_edges = most_edges_,
                                                 .max_depth = solved_.max_depth,
                                                 .capacity = static_cast<uint32_t>(solved_.headers.size()),
                                                 .padding = 0}});
  };
  solved_.count = fill_list(
      counters, &wt_counters::chains, Stage::wedge_chains, [&] { return solved_.headers.size(); }, run,
      [&](size_t rows) { solved_.reserve(context_, rows); });
  return solved_;
}

}  // namespace wavetracer
