// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/wedge_join.cl.
// A prefix has one work-item or a group of them: few prefixes or thousands may see a wedge.
#include "passes/wedge_join.hpp"

#include "passes/tuning.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

WedgeJoin::WedgeJoin(gpu::Context& context, uint32_t max_depth, double wavelength_m)
    : kernel_(context),
      max_depth_(max_depth),
      lanes_(tuning_of(context.info()).join_lanes),
      group_(tuning_of(context.info()).join_group),
      end_detour_m_(static_cast<float>(WT_END_DETOUR * wavelength_m)) {}

uint32_t WedgeJoin::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t first, uint32_t end,
                               const WedgeList& wedges, const RadioEnds& ends, WedgePairs* pairs, WedgeCandidates& into,
                               Counters& counters) {
  const size_t items = size_t{end - first} * lanes_;
  return into.fill(counters, Stage::wedge_join, [&] {
    const wt_wedge_join_arguments arguments{.count = prefixes.count,
                                            .first = first,
                                            .end = end,
                                            .lanes = lanes_,
                                            .transmitter_count = ends.transmitter_count,
                                            .groups = ends.receiver_capacity / 16,
                                            .max_depth = max_depth_,
                                            .capacity = into.capacity(),
                                            .end_detour_m = end_detour_m_,
                                            .pieces = 0,
                                            .floor = 0};
    kernel_({items, group_}, Stage::wedge_join,
            calls::wedge_join::wedge_join{.keys = prefixes.keys,
                                          .prefixes = prefixes.sorted,
                                          .receiver_of_end = ends.receiver_of_end,
                                          .links = ends.links,
                                          .wedges = wedges.wedges,
                                          .surfaces = scene.surfaces,
                                          .out = into.list(),
                                          .counters = counters.buffer(),
                                          .args = arguments});
    if (pairs && max_depth_ >= 2) (*pairs)(scene, prefixes, wedges, ends, arguments, into.list(), counters);
  });
}

}  // namespace wavetracer
