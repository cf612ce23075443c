// The memory of a ray cache on the device, one region per transmitter, and the definitions that its kernels are built
// with. What lies in heads and used depends on the kind: see kernels/lib/cache_*.clh.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/cache.h"

namespace wavetracer {

struct CacheTable {
  CacheConfig config;
  device::wt_cache_widths widths{};
  std::vector<device::wt_cache_region> regions;  // as on the device
  gpu::Buffer<device::wt_cache_entry> entries;
  gpu::Buffer<uint32_t> heads, used;
  gpu::Buffer<uint32_t> uses;  // frame of an entry's last answer, where look-ups touch it
  gpu::Buffer<device::wt_cache_region> device_regions;
  gpu::Buffer<device::wt_cache_counters> counters;  // one
  // With config.statistics: answers of each slot since its region was cleared; else a placeholder.
  gpu::Buffer<uint32_t> hits;
  gpu::Buffer<device::wt_cache_cycles> cycles;  // likewise, of each slot

  // One of the thesis' tables, faults and all.
  bool as_printed() const { return config.kind == "thesis" || config.kind == "thesis-chained"; }
  // Does it count what is used and give room up? Others are written over, or as the thesis prints them never cleared.
  bool evicts() const { return config.kind == "chained" || config.kind == "concurrent"; }
  // Of kernels that use lib/cache_table.clh. bulk: nobody writes while the kernel reads.
  gpu::Definitions definitions(bool bulk) const;
  uint64_t bytes() const;
  // Forgets everything in a region, or everywhere. Counters stay.
  void clear(gpu::Context& context, uint32_t region);
  void clear(gpu::Context& context);
};

// What moves, as entries of scope = "all" need to know it.
struct CacheMovement {
  gpu::Buffer<float> receivers;          // centres, recentred, four floats each (the last is padding)
  float radius_m = 0;                    // of the spheres around them
  gpu::Buffer<uint32_t> instance_since;  // frame in which each instance last moved
};

// Throws ConfigError where a transmitter's share of cache.buffer_size is too small, which no device is asked for.
void check_cache_share(const CacheConfig& config, uint32_t transmitter_count);

// Entries, heads and regions of this configuration, all empty. surface_count, primitive_count: of the world, for
// hash_method 2. Throws ConfigError that names limit and value where the device cannot hold cache.buffer_size, or a
// transmitter's share of it is too small.
CacheTable make_cache_table(gpu::Context& context, const CacheConfig& config, uint32_t transmitter_count,
                            uint32_t surface_count, uint32_t primitive_count);

// Nothing moves: placeholders.
CacheMovement make_cache_movement(gpu::Context& context);

}  // namespace wavetracer
