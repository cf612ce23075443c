// Who finds what rays hit: they are traced, or asked of a ray cache first (RayCache). Chosen once for a run.
#pragma once
#include <optional>

#include "passes/compact.hpp"
#include "passes/trace.hpp"
#include "simulation/ray_follower.hpp"
#include "simulation/ray_order.hpp"

namespace wavetracer {

class HitFinder {
 public:
  virtual ~HitFinder() = default;
  // Room for queues of so many rays, of the capacity that make_ray_queue gives them.
  virtual void reserve(uint64_t /*rays*/) {}
  // The nearest hits of all rays. depth: the number of their segment, from 1.
  virtual void find(const DeviceScene& scene, RayQueue& rays, HitList& hits, uint32_t depth) = 0;
  // After find(): which rays were answered without tracing, where somebody must know; valid until the next find().
  virtual std::optional<AnsweredRays> answered(uint32_t /*depth*/) const { return {}; }
  // After find(): the hits of every block of rays.
  virtual void count_blocks(const RayQueue& rays, HitList& hits, uint32_t depth) = 0;
};

// How the rays of this configuration traverse the scene.
TraceShape choose_shape(const gpu::DeviceInfo& device, const TraceConfig& trace, const OrderPlan& order);

class TracedHits final : public HitFinder {
 public:
  TracedHits(gpu::Context& context, const DeviceScene& scene, TraceShape shape, const LaunchShape& launch);
  void find(const DeviceScene& scene, RayQueue& rays, HitList& hits, uint32_t depth) override;
  void count_blocks(const RayQueue& rays, HitList& hits, uint32_t depth) override;

 private:
  Trace trace_;
  std::optional<Compact> compact_;  // where trace does not count the hits of blocks
};

}  // namespace wavetracer
