// SPDX-License-Identifier: Apache-2.0
// Finds the hits of rays: by tracing, or with a ray cache that is asked first (RayCache). The run chooses one of them.
#pragma once
#include <optional>

#include "passes/compact.hpp"
#include "passes/device_scene.hpp"
#include "passes/trace.hpp"
#include "simulation/ray_follower.hpp"
#include "simulation/ray_order.hpp"

namespace wavetracer {

class HitFinder {
 public:
  virtual ~HitFinder() = default;
  // Makes room for queues of this many rays, with the capacity that make_ray_queue gives them.
  virtual void reserve(uint64_t /*rays*/) {}
  // The nearest hits of all rays. depth: the number of their segment, from 1.
  virtual void find(const DeviceScene& scene, RayQueue& rays, HitList& hits, uint32_t depth) = 0;
  // After find(): the rays that were answered without tracing, if a cache is used; valid until the next find().
  virtual std::optional<AnsweredRays> answered(uint32_t /*depth*/) const { return {}; }
  // After find(): counts the hits of every block of rays.
  virtual void count_blocks(const RayQueue& rays, HitList& hits, uint32_t depth) = 0;
};

// Chooses the form in which the rays of this configuration traverse the scene.
TraceShape choose_shape(const gpu::DeviceInfo& device, const TraceConfig& trace, const OrderPlan& order);

class TracedHits final : public HitFinder {
 public:
  TracedHits(gpu::Context& context, const DeviceScene& scene, TraceShape shape, const LaunchShape& launch);
  void find(const DeviceScene& scene, RayQueue& rays, HitList& hits, uint32_t depth) override;
  void count_blocks(const RayQueue& rays, HitList& hits, uint32_t depth) override;

 private:
  Trace trace_;
  std::optional<Compact> compact_;  // set if trace does not count the hits of blocks
};

}  // namespace wavetracer
