// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/cache/cache_lookup.cl.
// A work-item takes a run of rays.
#include "passes/cache_lookup.hpp"
#include "wavetracer/device/arguments.h"

#include <stdexcept>

namespace wavetracer {

CacheLookup::CacheLookup(gpu::Context& context, const CacheTable& table) : work_(tuning_of(context.info()).cache_rays) {
  // Links along paths and withdrawn entries are written while others read.
  const bool writes = table.config.statistics || table.config.holds_all();
  gpu::Definitions definitions = table.definitions(!writes);
  definitions["WT_RAYS_PER_ITEM"] = work_.option();
  kernel_ = {context, definitions};
}

void CacheLookup::operator()(const CacheSurfaces& world, RayQueue& rays, HitList& hits, gpu::Buffer<float>& missed,
                             CacheTable& table, const CacheMovement& movement, uint32_t static_surfaces, uint32_t now,
                             bool touch, gpu::Buffer<uint32_t>* receptions) {
  if (table.config.holds_all() && !receptions)
    throw std::invalid_argument("cache_lookup: cache.scope = \"all\" without receptions");
  const CacheConfig& config = table.config;
  if ((config.own_points() && !config.exact() && !world.surfaces) || (config.holds_all() && !world.exact))
    throw std::invalid_argument("cache_lookup: no surfaces for cache.hit_point = \"own\" or cache.scope = \"all\"");
  kernel_(work_.range(rays.count), Stage::cache_lookup,
          calls::cache_lookup::cache_lookup{.rays = rays.planes,
                                            .hits = hits.planes,
                                            .missed = missed,
                                            .entries = table.entries,
                                            .heads = table.heads,
                                            .used = table.used,
                                            .regions = table.device_regions,
                                            .counters = table.counters,
                                            .surfaces = world.surfaces,
                                            .exact_surfaces = world.exact,
                                            .receivers = movement.receivers,
                                            .instance_since = movement.instance_since,
                                            .receptions = receptions,
                                            .entry_hits = table.hits,
                                            .uses = table.uses,
                                            .cycles = table.cycles,
                                            .args = wt_cache_lookup_arguments{.capacity = rays.capacity,
                                                                              .count = rays.count,
                                                                              .now = now,
                                                                              .touch = touch,
                                                                              .static_surfaces = static_surfaces,
                                                                              .radius_m = movement.radius_m,
                                                                              .widths = table.widths}});
}

}  // namespace wavetracer
