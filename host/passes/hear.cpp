// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/hear.cl.
// A work-item takes one ray.
#include "passes/hear.hpp"

#include "wavetracer/device/arguments.h"

namespace wavetracer {

Hear::Hear(gpu::Context& context, uint32_t roots, uint32_t first_listener, double margin_m)
    : kernel_(context),
      work_(tuning_of(context.info()).receive),
      roots_(roots),
      first_listener_(first_listener),
      margin_m_(static_cast<float>(margin_m)) {}

void Hear::operator()(const RayQueue& rays, const HitList& hits, const gpu::Buffer<uint64_t>& met,
                      const ListenerMap& map, Trie into) {
  const wt_hear_arguments arguments{.x = map.x_m,
                                    .y = map.y_m,
                                    .size = map.size_m,
                                    .low = map.low_m,
                                    .high = map.high_m,
                                    .margin = margin_m_,
                                    .columns = map.columns,
                                    .rows = map.rows,
                                    .capacity = rays.capacity,
                                    .ray_count = rays.count,
                                    .roots = roots_,
                                    .trie_mask = static_cast<uint32_t>(into.table.size() - 1),
                                    .first_listener = first_listener_};
  kernel_(work_.range(rays.count), Stage::hear,
          calls::hear::hear{.rays = rays.planes,
                            .hits = hits.planes,
                            .met = met,
                            .listeners = map.listeners,
                            .heights = map.heights,
                            .table = into.table,
                            .quarters = into.quarters,
                            .counters = into.counters.buffer(),
                            .args = arguments});
}

}  // namespace wavetracer
