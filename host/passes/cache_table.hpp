// SPDX-License-Identifier: Apache-2.0
// The memory of a ray cache on the device, one region per transmitter, and the definitions that its kernels are built
// with. The contents of heads and used depend on the kind: see kernels/lib/cache_*.clh.
#pragma once
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/cache.h"

namespace wavetracer {

struct CacheTable {
  CacheConfig config;
  device::wt_cache_widths widths{};
  std::vector<device::wt_cache_region> regions;  // the same as on the device
  gpu::Buffer<device::wt_cache_entry> entries;
  gpu::Buffer<uint32_t> heads, used;
  gpu::Buffer<uint32_t> uses;  // frame of an entry's last answer, where look-ups touch it
  gpu::Buffer<device::wt_cache_region> device_regions;
  gpu::Buffer<device::wt_cache_counters> counters;  // one element
  // With config.statistics: the answers of each slot since its region was cleared; else a placeholder.
  gpu::Buffer<uint32_t> hits;
  gpu::Buffer<device::wt_cache_cycles> cycles;  // the same for cycles

  // The definitions for kernels that use lib/cache_table.clh. bulk: nothing is written while the kernel reads.
  gpu::Definitions definitions(bool bulk) const;
  uint64_t bytes() const;
  // Removes everything in a region, or everywhere. Counters stay.
  void clear(gpu::Context& context, uint32_t region);
  void clear(gpu::Context& context);
};

// The things that move, which entries of scope = "all" depend on.
struct CacheMovement {
  gpu::Buffer<float> receivers;          // centres, recentred, four floats each (the last is padding)
  float radius_m = 0;                    // radius of the spheres around them
  gpu::Buffer<uint32_t> instance_since;  // frame in which each instance last moved
};

// Throws ConfigError where a transmitter's share of cache.buffer_size is too small. It needs no device.
void check_cache_share(const CacheConfig& config, uint32_t transmitter_count);

// Makes the entries, heads and regions of this configuration, all empty. surface_count, primitive_count: those of the
// world, for hash_method 2. Throws ConfigError that names limit and value where the device cannot hold
// cache.buffer_size, or a transmitter's share of it is too small.
CacheTable make_cache_table(gpu::Context& context, const CacheConfig& config, uint32_t transmitter_count,
                            uint32_t surface_count, uint32_t primitive_count);

// A movement in which nothing moves: placeholders.
CacheMovement make_cache_movement(gpu::Context& context);

}  // namespace wavetracer
