// SPDX-License-Identifier: Apache-2.0
// Our own kernels trace, the host reflects.
// In Munich the transmitter stands in a street, at a pedestrian's height.
#include "cache_rays.hpp"

#include <fmt/format.h>

#include <bit>
#include <filesystem>
#include <limits>

#include "passes/generate_rays.hpp"
#include "scene/city.hpp"
#include "scene/load.hpp"
#include "tracers.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::bench {
namespace {

constexpr int segment_count = 5;

Segment launch(gpu::Context& context, uint32_t count, const std::array<double, 3>& origin_m) {
  RayQueue queue = make_ray_queue(context, count, "launched rays");
  GenerateRays(context, LaunchDirections("hilbert", count, 1))(queue, {0, {0, 0, 0}}, 0, count);
  Segment segment{std::vector<Ray>(count, {{}, 0, {}, std::numeric_limits<float>::max()}),
                  std::vector<uint32_t>(count, WT_NONE), std::vector<uint32_t>(count, WT_NONE)};
  for (size_t axis = 0; axis < 3; axis++) {
    const auto plane = queue.planes.read((WT_RAY_DIRECTION + axis) * queue.capacity, count);
    for (size_t i = 0; i < count; i++) {
      segment.rays[i].origin[axis] = static_cast<float>(origin_m[axis]);
      segment.rays[i].direction[axis] = plane[i];
    }
  }
  return segment;
}

Segment reflect(const Segment& segment, std::span<const Hit> hits, std::span<const AccelTriangle> triangles) {
  Segment next;
  next.rays = next_segment(segment.rays, hits, triangles);
  for (const Hit& hit : hits) {
    if (hit.primitive == kNoPrimitive) continue;
    next.left.push_back(hit.primitive);
    next.surface.push_back(triangles[hit.primitive].surface);
  }
  return next;
}

}  // namespace

size_t SceneRays::count() const {
  size_t all = 0;
  for (const Segment& segment : segments) all += segment.rays.size();
  return all;
}

SceneRays scene_rays(gpu::Context& context, const std::string& shared, uint32_t launched) {
  const std::string munich = shared + "/scenes/munich/munich.xml";
  const bool there = std::filesystem::exists(munich);
  if (!there) fmt::print(stderr, "bench_cache: {} is not there, so the generated city is traced instead\n", munich);
  Config config;
  config.scene.generate = "--seed 1";
  SceneRays out{there ? "munich" : "city", there ? load_scene_file(munich, {}) : load_scene(config), {}};
  std::array<double, 3> origin_m{45.0, 90.0, 1.5};
  if (!there) origin_m = example_positions(parse_city_options(config.scene.generate)).front().position_m;
  for (int axis = 0; axis < 3; axis++) origin_m[static_cast<size_t>(axis)] -= out.scene.origin_m[axis];

  const std::vector<AccelTriangle> triangles = accel_triangles(out.scene);
  const DeviceScene device_scene = make_device_scene(context, out.scene, false);
  OurTracer tracer(context, device_scene, TraceShape::bvh2, launched);
  out.segments.push_back(launch(context, launched, origin_m));
  for (int k = 1; k < segment_count; k++) {
    std::vector<Hit> hits(out.segments.back().rays.size());
    tracer.load(out.segments.back().rays);
    tracer.run();
    tracer.fetch(hits);
    Segment next = reflect(out.segments.back(), hits, triangles);
    if (next.rays.empty()) break;
    out.segments.push_back(std::move(next));
  }
  return out;
}

RayQueue labelled_queue(gpu::Context& context, const Segment& segment) {
  const size_t count = segment.rays.size();
  RayQueue queue = make_ray_queue(context, count, "labelled rays", WT_RAY_LABELLED_PLANES);
  queue.count = static_cast<uint32_t>(count);
  std::vector<float> plane(count);
  const auto write = [&](size_t index, const auto& value) {
    for (size_t i = 0; i < count; i++) plane[i] = value(i);
    queue.planes.write(plane, index * queue.capacity);
  };
  for (size_t axis = 0; axis < 3; axis++) {
    write(WT_RAY_ORIGIN + axis, [&](size_t i) { return segment.rays[i].origin[axis]; });
    write(WT_RAY_DIRECTION + axis, [&](size_t i) { return segment.rays[i].direction[axis]; });
  }
  write(WT_RAY_SURFACE, [&](size_t i) { return std::bit_cast<float>(segment.surface[i]); });
  write(WT_RAY_LEFT, [&](size_t i) { return std::bit_cast<float>(segment.left[i]); });
  write(WT_RAY_REGION, [](size_t) { return std::bit_cast<float>(0u); });
  write(WT_RAY_ENTRY, [](size_t) { return std::bit_cast<float>(WT_NONE); });
  return queue;
}

}  // namespace wavetracer::bench
