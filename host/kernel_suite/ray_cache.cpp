// SPDX-License-Identifier: Apache-2.0
// The public face of the passes of the ray cache, with what lies between them: the rays that were not answered are put
// side by side, and records become planes and records again.
#include "wavetracer/kernels/ray_cache.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "kernel_suite/bvh_state.hpp"
#include "passes/cache_lookup.hpp"
#include "passes/cache_positions.hpp"
#include "passes/cache_purge.hpp"
#include "passes/cache_store.hpp"
#include "passes/compact.hpp"
#include "passes/gather_rays.hpp"
#include "passes/scan.hpp"

namespace wavetracer::kernels {

namespace {

constexpr const char* ray_cache_name = "RayCache";
constexpr uint32_t all_static = ~0u;

CacheConfig checked_config(const CacheConfig& config, uint32_t regions) {
  if (!config.on()) refuse(ray_cache_name, "kind = \"none\" is no table");
  if (config.holds_all() || config.innerframe)
    refuse(ray_cache_name, "scope = \"all\" and innerframe need a world that moves");
  if (regions == 0) refuse(ray_cache_name, "a table has at least one region");
  CacheConfig out = config;
  out.statistics = false;
  return out;
}

// The planes and bounds of triangles, which are surfaces of their own; those without area meet nothing.
std::vector<wt_surface> planes_of(const std::vector<float>& corners) {
  std::vector<wt_surface> surfaces(corners.size() / 9);
  for (size_t i = 0; i < surfaces.size(); ++i) {
    const float* c = corners.data() + 9 * i;
    const auto corner = [c](size_t k) { return glm::dvec3(c[3 * k], c[3 * k + 1], c[3 * k + 2]); };
    const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    const double length = glm::length(across);
    const glm::dvec3 normal = length > 0 ? across / length : glm::dvec3(0);
    surfaces[i].offset = static_cast<float>(glm::dot(normal, corner(0)));
    for (int axis = 0; axis < 3; ++axis) {
      surfaces[i].normal[axis] = static_cast<float>(normal[axis]);
      surfaces[i].lower[axis] = std::min({c[axis], c[3 + axis], c[6 + axis]});
      surfaces[i].upper[axis] = std::max({c[axis], c[3 + axis], c[6 + axis]});
    }
  }
  return surfaces;
}

// Memory of a pass as a public buffer, which shares it.
struct PublicMemory : Memory {
  PublicMemory(const std::shared_ptr<Context::State>& context, const gpu::Memory& memory) {
    state_ = std::make_shared<const Memory::State>(Memory::State{context, memory});
  }
};
template <class T>
Buffer<T> public_buffer(const std::shared_ptr<Context::State>& context, const gpu::Memory& memory) {
  Buffer<T> out;
  static_cast<Memory&>(out) = PublicMemory(context, memory);
  return out;
}

}  // namespace

struct RayCache::State : PassState {
  State(const Context& of, const CacheConfig& config, const Bvh::State* bvh, size_t triangles, uint32_t regions)
      : PassState(of),
        table(make_cache_table(context->gpu, checked_config(config, regions), regions,
                               count_of(ray_cache_name, triangles), count_of(ray_cache_name, triangles))),
        positions(regions),
        lookup(context->gpu, table),
        store(context->gpu, table),
        purge(context->gpu, table),
        compact(context->gpu),
        scan(context->gpu),
        gather(context->gpu, Stage::cache_gather),
        pack(context->gpu, Stage::cache_gather),
        movement(make_cache_movement(context->gpu)) {
    if (table.config.exact() || !table.config.own_points()) return;
    if (!bvh) refuse(ray_cache_name, "hit_point = \"own\" with a quantised key needs the Bvh of the triangles");
    if (bvh->context != context) refuse(ray_cache_name, "the Bvh belongs to another Context");
    surfaces = context->gpu.buffer(planes_of(bvh->corners.read()), "planes of triangles");
  }

  CacheTable table;
  CachePositions positions;
  CacheLookup lookup;
  CacheStore store;
  CachePurge purge;
  wavetracer::Compact compact;
  wavetracer::Scan scan;
  GatherRays gather;
  PackRays pack;
  CacheMovement movement;
  gpu::Buffer<wt_surface> surfaces;
  uint32_t frame = 1;

  RayQueue rays, missed;  // the batch, and those of it that were not answered
  HitList hits, missed_hits;
  gpu::Buffer<float> marks;  // as CacheLookup has them
  gpu::Buffer<uint32_t> blocks, indices;
  gpu::Buffer<wt_packed_ray> packed;
  Misses misses;
  bool waiting = false;  // a look-up waits for its store()
  RayCacheStatistics sums;

  void reserve(size_t n) {
    if (rays.capacity >= padded_capacity(n)) return;
    gpu::Context& gpu = context->gpu;
    rays = make_ray_queue(gpu, n, "rays of a batch", WT_RAY_LABELLED_PLANES);
    missed = make_ray_queue(gpu, n, "missed rays", WT_RAY_ENTRY);
    hits = make_hit_list(gpu, n);
    missed_hits = make_hit_list(gpu, n);
    marks = gpu.buffer<float>(rays.capacity, "missed");
    blocks = gpu.buffer<uint32_t>(compact.blocks(rays.capacity) + 1, "missed blocks");
    indices = gpu.buffer<uint32_t>(rays.capacity, "missed indices");
    packed = gpu.buffer<wt_packed_ray>(rays.capacity, "missed rays");
    misses.rays = public_buffer<Ray>(context, packed);
    misses.indices = public_buffer<uint32_t>(context, indices);
  }

  bool replaces_rays() const { return !table.config.exact() && !table.config.own_points(); }

  void answer(gpu::Buffer<wt_packed_ray>& from, uint32_t count, gpu::Buffer<wt_packed_hit>& to,
              const gpu::Buffer<uint32_t>* left, const gpu::Buffer<uint32_t>* regions) {
    gpu::Context& gpu = context->gpu;
    pack(from, count, rays, left, regions);
    const uint32_t none = WT_NONE;
    gpu.fill(hits.planes, &none, sizeof none, size_t{WT_HIT_PRIMITIVE} * hits.capacity * sizeof none,
             size_t{count} * sizeof none, Stage::cache_lookup);
    lookup({surfaces ? &surfaces : nullptr, nullptr}, rays, hits, marks, table, movement, all_static, frame,
           table.config.evicts());
    pack.unpack(hits, count, to);
    if (replaces_rays()) pack.unpack(rays, from);
    compact.count_blocks(marks, 0, count, blocks);
    misses.count = scan(blocks, compact.blocks(count));
    if (misses.count == 0) return;
    compact(marks, 0, count, blocks, indices);
    gather(rays, indices, static_cast<uint32_t>(misses.count), missed);
    pack.unpack(missed, packed);
  }

  // Adds the counters of the device, which have 32 bits, to the sums.
  void count() {
    const device::wt_cache_counters c = table.counters.read_one(0);
    table.counters.write(std::vector<device::wt_cache_counters>(1));
    sums.conflicts += c.conflicts;
    sums.stale += c.stale;
    sums.stored += c.stored;
    sums.replaced += c.replaced;
    sums.duplicates += c.duplicates;
    sums.dropped += c.dropped;
    sums.evicted += c.evicted;
  }
};

RayCache::RayCache(const Context& context, const CacheConfig& config, const Bvh& bvh, uint32_t regions)
    : state_(with_errors([&] {
        require_device(context, ray_cache_name, {.fp64 = false, .int64_atomics = true});
        return std::make_unique<State>(context, config, &bvh.state(), bvh.triangles(), regions);
      })) {}
RayCache::RayCache(const Context& context, const CacheConfig& config, size_t triangles, uint32_t regions)
    : state_(with_errors([&] {
        require_device(context, ray_cache_name, {.fp64 = false, .int64_atomics = true});
        return std::make_unique<State>(context, config, nullptr, triangles, regions);
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
  s.misses.count = 0;
  enqueue(s, call, [&] {
    if (count > 0) s.answer(from, count, to, left ? &left_of : nullptr, regions ? &region_of : nullptr);
  });
  s.rays.count = count;
  s.waiting = true;
  s.sums.look_ups += n;
  s.sums.hits += n - s.misses.count;
  return s.misses;
}

void RayCache::store(const Buffer<Hit>& traced, const Buffer<Hit>& hits, const Call& call) {
  State& s = *state_;
  if (!s.waiting) refuse(ray_cache_name, "store() without a look_up() before it");
  const auto count = static_cast<uint32_t>(s.misses.count);
  const gpu::Buffer<wt_packed_hit> from = hits_of(s, ray_cache_name, "traced", traced, count);
  gpu::Buffer<wt_packed_hit> to = hits_of(s, ray_cache_name, "hits", hits, s.rays.count);
  enqueue(s, call, [&] {
    if (count == 0) return;
    s.pack(from, count, s.missed_hits);
    s.store({nullptr, nullptr}, s.rays, s.missed, s.missed_hits, s.indices, s.hits, s.table, all_static, s.frame);
    s.pack.unpack(s.hits, s.rays.count, to);
  });
  s.waiting = false;
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
