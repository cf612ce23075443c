// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/cache_store.cl.
// A work-item takes a run of missed rays.
#include "passes/cache_store.hpp"
#include "wavetracer/device/arguments.h"

#include <stdexcept>

namespace wavetracer {

CacheStore::CacheStore(gpu::Context& context, const CacheTable& table) : work_(tuning_of(context.info()).cache_rays) {
  gpu::Definitions definitions = table.definitions(false);
  definitions["WT_CACHE_TALLY"] = "1";
  definitions["WT_RAYS_PER_ITEM"] = work_.option();
  kernel_ = {context, definitions};
}

void CacheStore::operator()(const DeviceScene& scene, RayQueue& rays, const RayQueue& missed,
                            const HitList& missed_hits, const gpu::Buffer<uint32_t>& indices, HitList& hits,
                            CacheTable& table, uint32_t static_surfaces, uint32_t now,
                            const gpu::Buffer<uint32_t>* receptions, gpu::Buffer<uint32_t>* receivers) {
  if (table.config.holds_all() && (!receptions || !receivers))
    throw std::invalid_argument("cache_store: cache.scope = \"all\" without receptions or receivers");
  if (missed.count == 0) return;
  kernel_(work_.range(missed.count), Stage::cache_store,
          calls::cache_store::cache_store{.rays = rays.planes,
                                          .missed = missed.planes,
                                          .missed_hits = missed_hits.planes,
                                          .indices = indices,
                                          .hits = hits.planes,
                                          .entries = table.entries,
                                          .heads = table.heads,
                                          .used = table.used,
                                          .regions = table.device_regions,
                                          .counters = table.counters,
                                          .exact_surfaces = scene.exact_surfaces,
                                          .receptions = receptions,
                                          .receivers = receivers,
                                          .cycles = table.cycles,
                                          .args = wt_cache_store_arguments{.capacity = rays.capacity,
                                                                           .missed_capacity = missed.capacity,
                                                                           .missed_count = missed.count,
                                                                           .now = now,
                                                                           .static_surfaces = static_surfaces,
                                                                           .widths = table.widths}});
}

}  // namespace wavetracer
