// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/target_edges.cl.
// A prefix has one work-item or a group of them, which share the points.
#include "passes/target_edges.hpp"

#include "passes/tuning.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

TargetEdges::TargetEdges(gpu::Context& context, uint32_t interactions, double wavelength_m)
    : kernel_(context),
      interactions_(interactions),
      lanes_(tuning_of(context.info()).join_lanes),
      group_(tuning_of(context.info()).join_group),
      end_detour_m_(static_cast<float>(WT_END_DETOUR * wavelength_m)) {}

uint32_t TargetEdges::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t first,
                                 uint32_t end, const WedgeList& wedges, const RadioEnds& ends,
                                 const TargetRows& targets, WedgeCandidates& into, Counters& counters) {
  const size_t items = size_t{end - first} * lanes_;
  return into.fill(counters, Stage::targets, [&] {
    kernel_({items, group_}, Stage::targets,
            calls::target_edges::target_edges{.keys = prefixes.keys,
                                              .prefixes = prefixes.sorted,
                                              .points = targets.points(),
                                              .links = ends.links,
                                              .wedges = wedges.wedges,
                                              .surfaces = scene.surfaces,
                                              .out = into.list(),
                                              .counters = counters.buffer(),
                                              .args = wt_wedge_join_arguments{.count = targets.count(),
                                                                              .first = first,
                                                                              .end = end,
                                                                              .lanes = lanes_,
                                                                              .transmitter_count = 0,
                                                                              .groups = ends.receiver_capacity / 16,
                                                                              .max_depth = interactions_,
                                                                              .capacity = into.capacity(),
                                                                              .end_detour_m = end_detour_m_,
                                                                              .pieces = 0,
                                                                              .floor = 0}});
  });
}

}  // namespace wavetracer
