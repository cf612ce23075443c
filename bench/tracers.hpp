// SPDX-License-Identifier: Apache-2.0
// The tracers that the trace benchmark compares, behind one interface: our kernels in each shape, and Embree if it was
// found. Rays must outlive the runs over them.
#pragma once
#include <algorithm>
#include <bit>
#include <chrono>
#include <limits>
#include <span>
#include <vector>

#ifdef WAVETRACER_EMBREE
#include "embree_peer.hpp"
#endif
#include "gpu/gpu.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/trace.hpp"
#include "segments.hpp"

namespace wavetracer::bench {

// Only run() is timed, by the tracer itself.
class Tracer {
 public:
  virtual ~Tracer() = default;
  virtual void load(std::span<const Ray> rays) = 0;
  virtual double run() = 0;  // seconds
  virtual void fetch(std::span<Hit> hits) const = 0;
};
// Our kernels. Rays are stored on the device, so uploads are not timed. On a GPU the time is that of the kernel by the
// device's clock, as in published figures; on a CPU it is wall time from launch to finish, as for Embree.
class OurTracer : public Tracer {
 public:
  OurTracer(gpu::Context& context, const DeviceScene& scene, TraceShape shape, size_t most_rays)
      : context_(context),
        scene_(scene),
        trace_(context, scene, shape),
        queue_(make_ray_queue(context, most_rays, "rays")),
        hits_(make_hit_list(context, most_rays)) {}

  void load(std::span<const Ray> rays) override {
    std::vector<float> plane(rays.size());
    for (size_t axis = 0; axis < 3; axis++) {
      std::transform(rays.begin(), rays.end(), plane.begin(), [&](const Ray& ray) { return ray.origin[axis]; });
      queue_.planes.write(plane, (WT_RAY_ORIGIN + axis) * queue_.capacity);
      std::transform(rays.begin(), rays.end(), plane.begin(), [&](const Ray& ray) { return ray.direction[axis]; });
      queue_.planes.write(plane, (WT_RAY_DIRECTION + axis) * queue_.capacity);
    }
    // Origins are off their surfaces already, so no surface is left out: ours does the same work as Embree.
    std::fill(plane.begin(), plane.end(), std::bit_cast<float>(WT_NONE));
    queue_.planes.write(plane, size_t{WT_RAY_SURFACE} * queue_.capacity);
    queue_.count = static_cast<uint32_t>(rays.size());
  }

  double run() override {
    context_.finish();
    context_.reset_profile();
    const auto start = std::chrono::steady_clock::now();
    trace_(scene_, queue_, hits_);
    context_.finish();
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return context_.info().cpu ? wall : context_.profile().at("trace");
  }

  void fetch(std::span<Hit> hits) const override {
    const auto t = hits_.planes.read(size_t{WT_HIT_T} * hits_.capacity, hits.size());
    const auto primitive = hits_.planes.read(size_t{WT_HIT_PRIMITIVE} * hits_.capacity, hits.size());
    for (size_t i = 0; i < hits.size(); i++) {
      const auto index = std::bit_cast<uint32_t>(primitive[i]);
      hits[i] = index == WT_NONE ? Hit{std::numeric_limits<float>::max(), kNoPrimitive} : Hit{t[i], index};
    }
  }

 private:
  gpu::Context& context_;
  const DeviceScene& scene_;
  Trace trace_;
  RayQueue queue_;
  HitList hits_;
};

#ifdef WAVETRACER_EMBREE
class EmbreeTracer : public Tracer {
 public:
  EmbreeTracer(std::span<const AccelTriangle> triangles, const EmbreeConfig& config) : peer_(triangles, config) {}
  void load(std::span<const Ray> rays) override {
    rays_ = rays;
    hits_.resize(rays.size());
  }
  double run() override { return peer_.trace(rays_, hits_); }
  void fetch(std::span<Hit> hits) const override { std::copy(hits_.begin(), hits_.end(), hits.begin()); }

 private:
  EmbreePeer peer_;
  std::span<const Ray> rays_;
  std::vector<Hit> hits_;
};
#endif

}  // namespace wavetracer::bench
