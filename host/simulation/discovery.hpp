// Discovery: rays from every transmitter leave the distinct sequences of surfaces that they lived through.
// The wavefront loop generate, order, trace, interact; batches bound the memory, whatever the number of rays.
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "passes/compact.hpp"
#include "passes/generate_rays.hpp"
#include "passes/interact.hpp"
#include "passes/scan.hpp"
#include "passes/sequences.hpp"
#include "passes/trace.hpp"
#include "simulation/ray_order.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// What discovery adds to FrameCounts.
struct DiscoveryCounts {
  uint64_t rays = 0, hits = 0;
  std::vector<uint64_t> segments_per_depth;
};

class Discovery {
 public:
  Discovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& config, const OrderPlan& order = {});
  // Fills sequences() for these transmitters (recentred metres).
  DiscoveryCounts operator()(const DeviceScene& scene, const std::vector<glm::dvec3>& transmitters);
  Sequences& sequences() { return sequences_; }

 private:
  // A part of the launch: rays of the transmitters from launch index first (counted over all transmitters) on.
  struct Batch {
    uint64_t first, count;
  };
  void launch(const std::vector<glm::dvec3>& transmitters, Batch batch);
  void trace_batch(const DeviceScene& scene, DiscoveryCounts& counts);

  gpu::Context& context_;
  TraceConfig config_;
  OrderPlan plan_;
  uint32_t max_depth_;
  uint64_t batch_rays_;
  LaunchDirections directions_;
  GenerateRays generate_;
  Trace trace_;
  std::optional<Compact> compact_;  // where trace does not count the hits of blocks
  Scan scan_;
  Interact interact_;
  Sequences sequences_;
  std::optional<RayOrder> order_;  // with the queues, if the plan has one
  RayQueue rays_, next_;
  HitList hits_;
};

}  // namespace wavetracer
