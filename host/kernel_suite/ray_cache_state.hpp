// SPDX-License-Identifier: Apache-2.0
// The private half of RayCache: the passes of a batch, and the memory between them.
#pragma once
#include <optional>
#include <span>

#include "kernel_suite/bvh_state.hpp"
#include "passes/cache_groups.hpp"
#include "passes/cache_lookup.hpp"
#include "passes/cache_positions.hpp"
#include "passes/cache_purge.hpp"
#include "passes/cache_store.hpp"
#include "passes/compact.hpp"
#include "passes/gather_rays.hpp"
#include "passes/scan.hpp"
#include "wavetracer/kernels/ray_cache.hpp"

namespace wavetracer::kernels {

constexpr const char* ray_cache_name = "RayCache";

// The rays of a batch that share hits: with innerframe.
struct RayGroups {
  RayGroups(gpu::Context& context, const CacheTable& table)
      : groups(context, table),
        may_refuse(!table.config.exact() && (table.config.own_points() || table.config.by_precision())) {}
  CacheGroups groups;
  bool may_refuse;  // a ray may not take the hit of its key
  gpu::Buffer<float> refused;
};

struct RayCache::State : PassState {
  // bvh: null for a tracer of the user's own.
  State(const Context& of, const CacheConfig& config, const Bvh::State* bvh, size_t triangles, uint32_t region_count,
        std::span<const uint32_t> objects);

  CacheTable table;
  CachePositions positions;
  CacheLookup lookup;
  CacheStore store;
  CachePurge purge;
  std::optional<RayGroups> grouped;
  wavetracer::Compact compact;
  wavetracer::Scan scan;
  GatherRays gather;
  PackRays pack;
  CacheMovement movement;
  gpu::Buffer<wt_surface> surfaces;          // for points of the rays' own
  gpu::Buffer<wt_exact_surface> in_objects;  // with scope = "all": the objects of triangles
  uint32_t objects = 0, frame = 1;

  RayQueue rays, missed;  // the batch, and those of it that are traced
  HitList hits, missed_hits;
  gpu::Buffer<float> marks;  // as CacheLookup has them
  gpu::Buffer<uint32_t> blocks, indices;
  gpu::Buffer<uint32_t> receptions;  // with scope = "all": no ray passes a receiver
  gpu::Buffer<wt_packed_ray> packed;
  gpu::Buffer<wt_packed_ray> asked;  // the rays that the look-up was given, which groups may replace
  Misses misses, refused;
  size_t waiting = 0;      // rays that the next store() has hits of
  uint32_t followers = 0;  // rays that the hits of these are for, too
  bool stores = false;     // a look-up or store() waits for a store()
  RayCacheStatistics sums;

  // Makes room for a batch.
  void reserve(size_t n);
  // The commands of a look-up of the rays `asked`, and of a store. Each sets `waiting`.
  void answer(uint32_t count, gpu::Buffer<wt_packed_hit>& to, const gpu::Buffer<uint32_t>* left,
              const gpu::Buffer<uint32_t>* regions);
  void keep(const gpu::Buffer<wt_packed_hit>& traced, gpu::Buffer<wt_packed_hit>& to);
  // Adds the counters of the device, which have 32 bits, to the sums.
  void count();

 private:
  CacheSurfaces world() const { return {surfaces ? &surfaces : nullptr, in_objects ? &in_objects : nullptr}; }
  gpu::Buffer<uint32_t>* receivers() { return receptions ? &receptions : nullptr; }
  bool replaces_rays() const { return !table.config.exact() && !table.config.own_points(); }
  uint32_t marked(const gpu::Buffer<float>& rays_to_trace);
  void gather_marked(const gpu::Buffer<float>& rays_to_trace, uint32_t count);
  void share();
};

}  // namespace wavetracer::kernels
