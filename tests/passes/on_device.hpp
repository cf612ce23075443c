// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of the passes: one device context per program, rays and hits as plain records, and queues of
// them. Each program runs its tests on one thread, on the default device (Oclgrind's, if it runs under it).
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "expected_device.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/trace.hpp"

namespace wavetracer::test {

using Float3 = std::array<float, 3>;

struct Ray {
  Float3 origin{}, direction{};
  uint32_t surface = WT_NONE;  // the surface that it leaves
  uint32_t node = WT_ROOT;
  bool operator==(const Ray&) const = default;
};

struct Hit {
  float t = 0;  // 0 on a miss, where the device leaves it undefined
  uint32_t primitive = WT_NONE, surface = WT_NONE;
  bool missed() const { return primitive == WT_NONE; }
  bool operator==(const Hit&) const = default;
};

// Kernels are compiled once for all tests of a program. It is never destroyed: at exit the driver may be gone already.
// It opens devices that the program refuses, so that kernels which need neither double precision nor 64-bit atomics,
// such as the sorts, are tested there as well; others do not compile there, and their tests fail.
inline gpu::Context& context() {
  static gpu::Context& shared = []() -> gpu::Context& {
    auto* const opened = new gpu::Context("", {.fp64 = false, .int64_atomics = false});
    require_expected_platform(opened->info());
    return *opened;
  }();
  return shared;
}

// Returns the number of items of a test: Oclgrind runs one work-item at a time, a ray in a millisecond.
inline uint32_t as_many(uint32_t elsewhere, uint32_t on_oclgrind) {
  return context().info().platform == "Oclgrind" ? on_oclgrind : elsewhere;
}

// Every shape of traversal that the device can run. BVH2 runs on all.
inline std::vector<TraceShape> shapes() {
  if (!context().info().cpu) return {TraceShape::bvh2};
  return {TraceShape::bvh2, TraceShape::bvh8, TraceShape::packet16};
}

inline std::string name_of(TraceShape shape) {
  return shape == TraceShape::bvh2 ? "bvh2" : shape == TraceShape::bvh8 ? "bvh8" : "packet16";
}

inline RayQueue upload(const std::vector<Ray>& rays) {
  RayQueue queue = make_ray_queue(context(), rays.size(), "test rays");
  queue.count = static_cast<uint32_t>(rays.size());
  std::vector<float> planes(queue.planes.size(), 0.0f);
  for (size_t i = 0; i < rays.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      planes[(WT_RAY_ORIGIN + axis) * queue.capacity + i] = rays[i].origin[axis];
      planes[(WT_RAY_DIRECTION + axis) * queue.capacity + i] = rays[i].direction[axis];
    }
    planes[size_t{WT_RAY_NODE} * queue.capacity + i] = std::bit_cast<float>(rays[i].node);
    planes[size_t{WT_RAY_SURFACE} * queue.capacity + i] = std::bit_cast<float>(rays[i].surface);
  }
  queue.planes.write(planes);
  return queue;
}

inline std::vector<Ray> download(const RayQueue& queue) {
  const std::vector<float> planes = queue.planes.read();
  std::vector<Ray> rays(queue.count);
  for (size_t i = 0; i < rays.size(); ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      rays[i].origin[axis] = planes[(WT_RAY_ORIGIN + axis) * queue.capacity + i];
      rays[i].direction[axis] = planes[(WT_RAY_DIRECTION + axis) * queue.capacity + i];
    }
    rays[i].node = std::bit_cast<uint32_t>(planes[size_t{WT_RAY_NODE} * queue.capacity + i]);
    rays[i].surface = std::bit_cast<uint32_t>(planes[size_t{WT_RAY_SURFACE} * queue.capacity + i]);
  }
  return rays;
}

inline std::vector<Hit> download(const HitList& list, size_t count) {
  const std::vector<float> planes = list.planes.read();
  std::vector<Hit> hits(count);
  for (size_t i = 0; i < count; ++i) {
    hits[i].primitive = std::bit_cast<uint32_t>(planes[size_t{WT_HIT_PRIMITIVE} * list.capacity + i]);
    hits[i].surface = std::bit_cast<uint32_t>(planes[size_t{WT_HIT_SURFACE} * list.capacity + i]);
    hits[i].t = hits[i].missed() ? 0.0f : planes[size_t{WT_HIT_T} * list.capacity + i];
  }
  return hits;
}

// Returns the value that make_device_scene needs for rays that start outside the scene: their largest absolute
// coordinate.
inline double reach_of(const std::vector<Ray>& rays) {
  double reach = 0;
  for (const Ray& ray : rays)
    for (const float x : ray.origin) reach = std::max(reach, std::abs(double{x}));
  return reach;
}

// The nearest hit of each ray.
inline std::vector<Hit> trace(const DeviceScene& scene, TraceShape shape, const std::vector<Ray>& rays) {
  const RayQueue queue = upload(rays);
  HitList list = make_hit_list(context(), rays.size());
  Trace pass(context(), scene, shape);
  pass(scene, queue, list);
  return download(list, rays.size());
}

inline size_t misses(const std::vector<Hit>& hits) {
  size_t count = 0;
  for (const Hit& hit : hits) count += hit.missed();
  return count;
}

}  // namespace wavetracer::test
