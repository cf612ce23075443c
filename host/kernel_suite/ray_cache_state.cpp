// SPDX-License-Identifier: Apache-2.0
// A batch of a ray cache, pass by pass, as host/simulation/cache_misses.cpp has them for the rays of a frame.
// The rays that must be traced are put side by side; records become planes and records again.
#include "kernel_suite/ray_cache_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace wavetracer::kernels {

namespace {

constexpr uint32_t all_static = ~0u;

// Throws Error for a number outside of the range that the documentation of the configuration gives.
void check_number(const char* name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    refuse(ray_cache_name, fmt::format("{} = {}: it is {} to {}", name, value, least, most));
}

CacheConfig checked_config(const CacheConfig& config, uint32_t regions) {
  if (!config.on()) refuse(ray_cache_name, "kind = \"none\" is no table");
  if (config.exact() && config.holds_all())
    refuse(ray_cache_name,
           "key = \"exact\" does not notice what moves: use scope = \"static\", or key = \"quantised\"");
  if (config.exact() && config.as_printed())
    refuse(ray_cache_name, "key = \"exact\" is no key of the thesis' tables: use \"quantised\", or another kind");
  if (regions == 0) refuse(ray_cache_name, "a table has at least one region");
  check_number("hash_method", config.hash_method, 1, 3);
  check_number("division", config.division, 1, WT_CACHE_MAX_DIVISION);
  check_number("load_factor", config.load_factor, 1, 64);
  check_number("readers_number", config.readers_number, 1, 65535);
  check_number("position_step_m", config.position_step_m, 1e-3, 1e3);
  check_number("residual_value", config.residual_value, 0, 1e6);
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

// Triangles as surfaces that know their object and nothing else.
std::vector<wt_exact_surface> surfaces_in(std::span<const uint32_t> objects) {
  std::vector<wt_exact_surface> surfaces(objects.size());
  for (size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] != no_object && objects[i] >= objects.size())
      refuse(ray_cache_name,
             fmt::format("triangle {} belongs to object {}: there are no more objects than triangles", i, objects[i]));
    surfaces[i].instance = objects[i];
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

static_assert(no_object == WT_NONE);

RayCache::State::State(const Context& of, const CacheConfig& config, const Bvh::State* bvh, size_t triangles,
                       uint32_t region_count, std::span<const uint32_t> objects_of_triangles)
    : PassState(of),
      table(make_cache_table(context->gpu, checked_config(config, region_count), region_count,
                             count_of(ray_cache_name, triangles), count_of(ray_cache_name, triangles))),
      positions(region_count),
      lookup(context->gpu, table),
      store(context->gpu, table),
      purge(context->gpu, table),
      compact(context->gpu),
      scan(context->gpu),
      gather(context->gpu, Stage::cache_gather),
      pack(context->gpu, Stage::cache_gather),
      movement(make_cache_movement(context->gpu)) {
  if (config.innerframe) grouped.emplace(context->gpu, table);
  if (config.holds_all() != !objects_of_triangles.empty())
    refuse(ray_cache_name, config.holds_all() ? "scope = \"all\" needs the objects of the triangles"
                                              : "objects were given, which scope = \"static\" does not have");
  if (config.holds_all()) {
    if (objects_of_triangles.size() != triangles)
      refuse(ray_cache_name, fmt::format("objects of {} triangles, of {}", objects_of_triangles.size(), triangles));
    in_objects = context->gpu.buffer(surfaces_in(objects_of_triangles), "objects of triangles");
    for (const uint32_t object : objects_of_triangles)
      if (object != no_object) objects = std::max(objects, object + 1);
    movement.instance_since = context->gpu.buffer(std::vector<uint32_t>(std::max(objects, 1u)), "objects moved");
  }
  if (config.exact() || !config.own_points()) return;
  if (!bvh) refuse(ray_cache_name, "hit_point = \"own\" with a quantised key needs the Bvh of the triangles");
  if (bvh->context != context) refuse(ray_cache_name, "the Bvh belongs to another Context");
  surfaces = context->gpu.buffer(planes_of(bvh->corners.read()), "planes of triangles");
}

void RayCache::State::reserve(size_t n) {
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
  misses.rays = refused.rays = public_buffer<Ray>(context, packed);
  misses.indices = refused.indices = public_buffer<uint32_t>(context, indices);
  if (grouped) {
    grouped->groups.reserve(rays.capacity);
    grouped->refused = gpu.buffer<float>(rays.capacity, "refused rays");
  }
  if (!table.config.holds_all()) return;
  receptions = gpu.buffer<uint32_t>(rays.capacity, "receptions");
  gpu.fill(receptions, WT_NONE);
}

uint32_t RayCache::State::marked(const gpu::Buffer<float>& rays_to_trace) {
  compact.count_blocks(rays_to_trace, 0, rays.count, blocks);
  return scan(blocks, compact.blocks(rays.count));
}

// Puts the rays side by side that marked() has counted.
void RayCache::State::gather_marked(const gpu::Buffer<float>& rays_to_trace, uint32_t count) {
  waiting = count;
  if (count == 0) return;
  compact(rays_to_trace, 0, rays.count, blocks, indices);
  gather(rays, indices, count, missed);
  pack.unpack(missed, packed);
}

void RayCache::State::answer(uint32_t count, gpu::Buffer<wt_packed_hit>& to, const gpu::Buffer<uint32_t>* left,
                             const gpu::Buffer<uint32_t>* regions) {
  pack(asked, count, rays, left, regions);
  const uint32_t none = WT_NONE;
  context->gpu.fill(hits.planes, &none, sizeof none, size_t{WT_HIT_PRIMITIVE} * hits.capacity * sizeof none,
                    size_t{count} * sizeof none, Stage::cache_lookup);
  lookup(world(), rays, hits, marks, table, movement, all_static, frame, table.config.evicts(), receivers());
  pack.unpack(hits, count, to);
  if (replaces_rays()) pack.unpack(rays, asked);
  uint32_t traced = marked(marks);
  sums.hits += count - traced;
  followers = 0;
  if (grouped && traced > 0) {
    grouped->groups.elect(rays, marks, traced, table, all_static);
    const uint32_t leaders = marked(marks);
    followers = traced - leaders;
    traced = leaders;
  }
  gather_marked(marks, traced);
}

void RayCache::State::keep(const gpu::Buffer<wt_packed_hit>& traced, gpu::Buffer<wt_packed_hit>& to) {
  const auto count = static_cast<uint32_t>(waiting);
  waiting = 0;
  if (count == 0) return;
  pack(traced, count, missed_hits);
  store(world(), rays, missed, missed_hits, indices, hits, table, all_static, frame, receivers(), receivers());
  if (followers > 0) share();
  pack.unpack(hits, rays.count, to);
}

// Hands the hits of the first rays of each key to those that follow them.
void RayCache::State::share() {
  RayGroups& g = *grouped;
  g.groups.share(world(), rays, hits, marks, g.refused, table, frame, receivers());
  if (replaces_rays()) pack.unpack(rays, asked);
  const uint32_t refusing = g.may_refuse ? marked(g.refused) : 0;
  sums.shared += followers - refusing;
  followers = 0;
  gather_marked(g.refused, refusing);
}

void RayCache::State::count() {
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

}  // namespace wavetracer::kernels
