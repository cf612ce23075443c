// SPDX-License-Identifier: Apache-2.0
// Rays and hits must come back from planes as they went; hits must be those of trace.
#include "packed_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <random>

#include "kernel_costs.hpp"
#include "passes/curves.hpp"
#include "passes/device_scene.hpp"
#include "passes/generate_rays.hpp"
#include "passes/pack_rays.hpp"
#include "passes/trace.hpp"
#include "passes/trace_rays.hpp"
#include "places.hpp"
#include "scene/load.hpp"

namespace wavetracer::bench {
namespace {

constexpr std::array pack_kernels{"pack_rays/rays_to_planes", "pack_rays/planes_to_rays", "pack_rays/hits_to_planes",
                                  "pack_rays/planes_to_hits"};
constexpr std::array hit_kernels{"trace_rays/nearest_hits", "trace_rays/any_hits"};
constexpr double plane_ray = 6.0 * sizeof(float), plane_hit = WT_HIT_PLANES * sizeof(float);

bool wants_any(const KernelRows& rows, std::span<const char* const> kernels) {
  return std::ranges::any_of(kernels, [&](const char* kernel) { return rows.wants(kernel); });
}

// Counts words of some planes that differ, among the first `count` elements.
size_t differing_planes(const gpu::Buffer<float>& a, size_t a_capacity, const gpu::Buffer<float>& b, size_t b_capacity,
                        std::initializer_list<uint32_t> planes, size_t count) {
  size_t differing = 0;
  for (const uint32_t plane : planes) {
    const auto x = a.read(plane * a_capacity, count), y = b.read(plane * b_capacity, count);
    for (size_t i = 0; i < count; i++) differing += std::bit_cast<uint32_t>(x[i]) != std::bit_cast<uint32_t>(y[i]);
  }
  return differing;
}

RayQueue launched(gpu::Context& context, uint32_t count, const glm::dvec3& from_m) {
  RayQueue rays = make_ray_queue(context, count, "rays");
  GenerateRays(context, LaunchDirections("hilbert", count, 1))(rays, {0, from_m}, 0, count);
  return rays;
}

KernelCase one_kernel(const char* kernel, const std::string& variant, const char* element, double elements,
                      const KernelWork& work, std::function<void()> run, std::function<size_t()> wrong) {
  return {.variant = variant,
          .kernels = {{kernel, {element, elements, work}}},
          .run = std::move(run),
          .wrong = std::move(wrong)};
}

void pack(KernelRows& rows, gpu::Context& context, uint32_t n) {
  PackRays pack_rays(context);
  const std::string variant = fmt::format("n = {}", n);
  const RayQueue rays = launched(context, n, {1, 2, 3});
  RayQueue back = make_ray_queue(context, n, "rays back");
  auto packed = context.buffer<wt_packed_ray>(n, "packed rays");
  pack_rays.unpack(rays, packed);
  pack_rays(packed, n, back);
  const size_t checked = std::min(n, 1u << 20);
  const auto wrong_rays = [&] {
    return differing_planes(rays.planes, rays.capacity, back.planes, back.capacity,
                            {WT_RAY_ORIGIN, WT_RAY_ORIGIN + 2, WT_RAY_DIRECTION, WT_RAY_DIRECTION + 2}, checked);
  };
  rows.measure(context,
               one_kernel(
                   "pack_rays/planes_to_rays", variant, "rays", n, {.bytes = plane_ray + sizeof(wt_packed_ray)},
                   [&] { pack_rays.unpack(rays, packed); }, wrong_rays));
  rows.measure(context, one_kernel(
                            "pack_rays/rays_to_planes", variant, "rays", n,
                            {.bytes = sizeof(wt_packed_ray) + 4.0 * WT_RAY_PLANES}, [&] { pack_rays(packed, n, back); },
                            wrong_rays));
  HitList hits = make_hit_list(context, n), hits_back = make_hit_list(context, n);
  const auto packed_hits = [&] {
    std::mt19937 generator(1);
    std::vector<wt_packed_hit> all(n);
    for (wt_packed_hit& hit : all)
      hit = {static_cast<float>(generator() >> 8), static_cast<uint32_t>(generator() >> 1), 0, 0};
    return context.buffer(all, "packed hits");
  }();
  auto unpacked = context.buffer<wt_packed_hit>(n, "unpacked hits");
  const auto wrong_hits = [&] {
    const auto x = packed_hits.read(0, checked), y = unpacked.read(0, checked);
    size_t differing = 0;
    for (size_t i = 0; i < checked; i++) differing += x[i].t != y[i].t || x[i].primitive != y[i].primitive;
    return differing;
  };
  pack_rays(packed_hits, n, hits);
  pack_rays.unpack(hits, n, unpacked);
  const KernelWork hit_work{.bytes = plane_hit + sizeof(wt_packed_hit)};
  rows.measure(context, one_kernel(
                            "pack_rays/hits_to_planes", variant, "hits", n, hit_work,
                            [&] { pack_rays(packed_hits, n, hits); }, wrong_hits));
  rows.measure(context, one_kernel(
                            "pack_rays/planes_to_hits", variant, "hits", n,
                            {.bytes = 2.0 * sizeof(float) + sizeof(wt_packed_hit)},
                            [&] { pack_rays.unpack(hits, n, unpacked); }, wrong_hits));
}

void trace(KernelRows& rows, gpu::Context& context, const std::string& shared, uint32_t count) {
  const std::optional<Place> munich = munich_place(shared, 1, 1);
  const Config config = config_of(munich ? *munich : city_place(1, 1), 1, 1);
  const Scene scene = load_scene(config);
  const DeviceScene trees = make_device_scene(context, scene, false);
  const auto& at = config.transmitters.front().position_m;
  const RayQueue queue = launched(context, count, glm::dvec3(at[0], at[1], at[2]) - scene.origin_m);
  HitList expected = make_hit_list(context, count), hits = make_hit_list(context, count);
  Trace(context, trees, trees.cpu ? TraceShape::bvh8 : TraceShape::bvh2)(trees, queue, expected);
  PackRays pack_rays(context);
  auto packed = context.buffer<wt_packed_ray>(count, "packed rays");
  pack_rays.unpack(queue, packed);
  std::vector<float> corners;
  for (const AccelTriangle& triangle : accel_triangles(scene))
    for (const auto& corner : triangle.v) corners.insert(corners.end(), corner, corner + 3);
  const auto device_corners = context.buffer(corners, "corners");
  auto found = context.buffer<wt_packed_hit>(count, "packed hits");
  auto met = context.buffer<uint32_t>(count, "met");
  TraceRays trace_rays(context, trees);
  const std::string variant = fmt::format("{} rays of a launch", count);
  const double operations = tree_operations(scene.triangles.size());
  rows.measure(context, one_kernel(
                            "trace_rays/nearest_hits", variant, "rays", count,
                            {.bytes = sizeof(wt_packed_ray) + sizeof(wt_packed_hit), .operations = operations},
                            [&] { trace_rays.nearest(trees, device_corners, packed, count, found); },
                            [&] {
                              pack_rays(found, count, hits);
                              return differing_planes(expected.planes, expected.capacity, hits.planes, hits.capacity,
                                                      {WT_HIT_PRIMITIVE}, count);
                            }));
  rows.measure(context, one_kernel(
                            "trace_rays/any_hits", variant, "rays", count,
                            {.bytes = sizeof(wt_packed_ray) + 4, .operations = operations},
                            [&] { trace_rays.any(trees, packed, count, met); },
                            [&] {
                              const auto primitive =
                                  expected.planes.read(size_t{WT_HIT_PRIMITIVE} * expected.capacity, count);
                              const auto flags = met.read();
                              size_t differing = 0;
                              for (uint32_t i = 0; i < count; i++)
                                differing += flags[i] != (std::bit_cast<uint32_t>(primitive[i]) != WT_NONE);
                              return differing;
                            }));
}

// Keys of as many cells as a component's bits allow.
void point_keys(KernelRows& rows, gpu::Context& context, uint32_t n) {
  for (const char* name : {"morton3", "hilbert3"}) {
    PointKeys keys_of(context, name, 32);
    std::mt19937 generator(1);
    std::vector<float> components(3 * size_t{n});
    for (float& component : components) component = static_cast<float>(generator() >> 8) * 0x1p-24f;
    const auto points = context.buffer(components, "points");
    auto keys = context.buffer<uint32_t>(n, "keys");
    const std::array<float, 3> lower{0, 0, 0}, upper{1, 1, 1};
    const CurveBox box{lower, upper, uint64_t{1} << 10};
    rows.measure(context,
                 one_kernel(
                     "curves/point_keys", fmt::format("{}, n = {}", name, n), "points", n,
                     {.bytes = 16, .operations = 9}, [&] { keys_of(points, 3, n, box, keys); }, [] { return 0; }));
  }
}

}  // namespace

void measure_packed_kernels(KernelRows& rows, gpu::Context& context, const std::string& shared, uint32_t n,
                            uint32_t ray_count) {
  if (rows.wants("curves/point_keys")) point_keys(rows, context, n);
  if (wants_any(rows, pack_kernels)) pack(rows, context, n);
  if (wants_any(rows, hit_kernels)) trace(rows, context, shared, ray_count);
}

}  // namespace wavetracer::bench
