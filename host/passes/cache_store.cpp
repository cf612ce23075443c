// Host side of kernels/cache_store.cl.
// On CPUs a work-item takes a run of missed rays, on GPUs one.
#include "passes/cache_store.hpp"

#include <stdexcept>
#include <string>

namespace wavetracer {

CacheStore::CacheStore(gpu::Context& context, const CacheTable& table)
    : rays_per_item_(context.info().cpu ? 256 : 1),
      local_(context.info().cpu ? 1 : context.info().simple_local_size()) {
  gpu::Definitions definitions = table.definitions(false);
  definitions["WT_CACHE_TALLY"] = "1";
  definitions["WT_RAYS_PER_ITEM"] = std::to_string(rays_per_item_) + "u";
  kernel_ = context.kernel("cache_store", "cache_store", definitions);
}

void CacheStore::operator()(RayQueue& rays, const RayQueue& missed, const HitList& missed_hits,
                            const gpu::Buffer<uint32_t>& indices, HitList& hits, CacheTable& table,
                            uint32_t static_surfaces, uint32_t now, const gpu::Buffer<uint32_t>* receptions) {
  if (table.config.scope == "all" && !receptions)
    throw std::invalid_argument("cache_store: cache.scope = \"all\" without receptions");
  if (missed.count == 0) return;
  const size_t items = (size_t{missed.count} + rays_per_item_ - 1) / rays_per_item_;
  kernel_({items, local_}, "cache_store", rays.planes, rays.capacity, missed.planes, missed_hits.planes,
          missed.capacity, missed.count, indices, hits.planes, table.entries, table.heads, table.used,
          table.device_regions, table.counters, table.widths, now, static_surfaces, receptions ? *receptions : indices);
}

}  // namespace wavetracer
