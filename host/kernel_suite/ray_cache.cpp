// SPDX-License-Identifier: Apache-2.0
// The public face of the ray cache: it checks the arguments of a batch and counts frames.
// The commands of the batch are in ray_cache_state.cpp.
#include "wavetracer/kernels/ray_cache.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "kernel_suite/ray_cache_state.hpp"

namespace wavetracer::kernels {

RayCache::RayCache(const Context& context, const CacheConfig& config, const Bvh& bvh, uint32_t regions,
                   std::span<const uint32_t> objects)
    : state_(with_errors([&] {
        require_device(context, ray_cache_name, {.fp64 = false, .int64_atomics = true});
        return std::make_unique<State>(context, config, &bvh.state(), bvh.triangles(), regions, objects);
      })) {}
RayCache::RayCache(const Context& context, const CacheConfig& config, size_t triangles, uint32_t regions,
                   std::span<const uint32_t> objects)
    : state_(with_errors([&] {
        require_device(context, ray_cache_name, {.fp64 = false, .int64_atomics = true});
        return std::make_unique<State>(context, config, nullptr, triangles, regions, objects);
      })) {}
RayCache::~RayCache() = default;
RayCache::RayCache(RayCache&&) noexcept = default;
RayCache& RayCache::operator=(RayCache&&) noexcept = default;

const RayCache::Misses& RayCache::look_up(const Buffer<Ray>& rays, size_t n, const Buffer<Hit>& hits,
                                          const Buffer<uint32_t>* left, const Buffer<uint32_t>* regions,
                                          const Call& call) {
  State& s = *state_;
  const uint32_t count = rays_count(ray_cache_name, n);
  gpu::Buffer<wt_packed_ray> from = rays_of(s, ray_cache_name, "rays", rays, n);
  gpu::Buffer<wt_packed_hit> to = hits_of(s, ray_cache_name, "hits", hits, n);
  gpu::Buffer<uint32_t> left_of, region_of;
  if (left) left_of = buffer_of(s, ray_cache_name, "left", *left, n);
  if (regions) region_of = buffer_of(s, ray_cache_name, "regions", *regions, n);
  with_errors([&] { s.reserve(n); });
  s.misses.count = s.refused.count = s.waiting = 0;
  s.asked = from;
  enqueue(s, call, [&] {
    if (count > 0) s.answer(count, to, left ? &left_of : nullptr, regions ? &region_of : nullptr);
  });
  s.rays.count = count;
  s.stores = true;
  s.sums.look_ups += n;
  s.misses.count = s.waiting;
  return s.misses;
}

const RayCache::Misses& RayCache::store(const Buffer<Hit>& traced, const Buffer<Hit>& hits, const Call& call) {
  State& s = *state_;
  if (!s.stores) refuse(ray_cache_name, "store() without a look_up() before it");
  const gpu::Buffer<wt_packed_hit> from = hits_of(s, ray_cache_name, "traced", traced, s.waiting);
  gpu::Buffer<wt_packed_hit> to = hits_of(s, ray_cache_name, "hits", hits, s.rays.count);
  enqueue(s, call, [&] { s.keep(from, to); });
  s.refused.count = s.waiting;
  s.stores = s.waiting > 0;
  if (!s.stores) s.asked = {};
  return s.refused;
}

void RayCache::next_frame() { ++state_->frame; }

void RayCache::place_region(uint32_t region, const std::array<double, 3>& position_m) {
  State& s = *state_;
  if (region >= s.table.regions.size())
    refuse(ray_cache_name, fmt::format("region {} of {}", region, s.table.regions.size()));
  if (!s.table.config.by_position()) return;
  with_errors([&] {
    if (!s.positions.note(s.table, region, {position_m[0], position_m[1], position_m[2]}, s.frame)) return;
    s.table.device_regions.write(s.table.regions);
    if (s.table.config.evicts()) s.table.clear(s.context->gpu, region);  // other tables write over stale entries
  });
}

void RayCache::move_object(uint32_t object) {
  State& s = *state_;
  if (object >= s.objects) refuse(ray_cache_name, fmt::format("object {} of {}", object, s.objects));
  with_errors([&] { s.movement.instance_since.write({&s.frame, 1}, object); });
}

void RayCache::purge(uint32_t frames) {
  State& s = *state_;
  if (!s.table.config.evicts()) return;
  with_errors([&] { s.purge(s.context->gpu, s.table, s.frame - std::min(frames, s.frame) + 1); });
}

void RayCache::clear() {
  with_errors([&] { state_->table.clear(state_->context->gpu); });
}

RayCacheStatistics RayCache::statistics() {
  State& s = *state_;
  return with_errors([&] {
    s.count();
    RayCacheStatistics out = s.sums;
    const std::vector<uint32_t> used = s.table.used.read();
    for (size_t r = 0; r < used.size(); ++r) {
      out.entries += s.table.regions[r].entries;
      out.used += std::min(used[r], s.table.regions[r].entries);  // a chained table counts what it would hand out
    }
    out.bytes = s.table.bytes();
    return out;
  });
}

}  // namespace wavetracer::kernels
