// Host side of kernels/cache_store.cl.
// One missed ray a work-item.
#include "passes/cache_store.hpp"

#include <stdexcept>

namespace wavetracer {

CacheStore::CacheStore(gpu::Context& context, const CacheTable& table)
    : kernel_(context.kernel("cache_store", "cache_store", table.definitions(false))),
      local_(context.info().simple_local_size()) {}

void CacheStore::operator()(RayQueue& rays, const RayQueue& missed, const HitList& missed_hits,
                            const gpu::Buffer<uint32_t>& indices, HitList& hits, CacheTable& table,
                            uint32_t static_surfaces, uint32_t now, const gpu::Buffer<uint32_t>* receptions) {
  if (table.config.scope == "all" && !receptions)
    throw std::invalid_argument("cache_store: cache.scope = \"all\" without receptions");
  if (missed.count == 0) return;
  kernel_({missed.count, local_}, "cache_store", rays.planes, rays.capacity, missed.planes, missed_hits.planes,
          missed.capacity, missed.count, indices, hits.planes, table.entries, table.heads, table.used,
          table.device_regions, table.counters, table.widths, now, static_surfaces,
          receptions ? *receptions : indices);
}

}  // namespace wavetracer
