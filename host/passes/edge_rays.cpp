// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/edge_rays.cl.
// A work-item takes one ray.
#include "passes/edge_rays.hpp"

#include "wavetracer/device/arguments.h"

namespace wavetracer {

EdgeRays::EdgeRays(gpu::Context& context, uint32_t each, uint32_t pieces, uint32_t roots, float low_m, float high_m)
    : kernel_(context),
      work_(tuning_of(context.info()).receive),
      each_(each),
      pieces_(pieces),
      roots_(roots),
      low_m_(low_m),
      high_m_(high_m) {}

void EdgeRays::operator()(RayQueue& queue, const WedgePrefixList& prefixes, const WedgeList& wedges, uint64_t first,
                          uint32_t count) {
  const wt_edge_rays_arguments arguments{.capacity = queue.capacity,
                                         .first = static_cast<uint32_t>(first / each_),
                                         .number = static_cast<uint32_t>(first % each_),
                                         .count = count,
                                         .each = each_,
                                         .pieces = pieces_,
                                         .roots = roots_,
                                         .low = low_m_,
                                         .high = high_m_};
  kernel_(work_.range(count), Stage::edge_rays,
          calls::edge_rays::edge_rays{.keys = prefixes.keys,
                                      .prefixes = prefixes.sorted,
                                      .wedges = wedges.wedges,
                                      .rays = queue.planes,
                                      .args = arguments});
  queue.count = count;
}

}  // namespace wavetracer
