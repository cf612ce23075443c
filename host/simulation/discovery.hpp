// Discovery: rays from every transmitter leave the distinct sequences of surfaces that they lived through.
// The wavefront loop generate, order, trace, interact; batches bound the memory, whatever the number of rays. With
// transmission rays split where they hit, and what went through waits until the reflected ones are through.
#pragma once
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "passes/compact.hpp"
#include "passes/generate_rays.hpp"
#include "passes/interact.hpp"
#include "passes/label_rays.hpp"
#include "passes/scan.hpp"
#include "passes/sequences.hpp"
#include "passes/trace.hpp"
#include "simulation/frame_watch.hpp"
#include "simulation/ray_cache.hpp"
#include "simulation/ray_order.hpp"
#include "simulation/ray_trails.hpp"
#include "simulation/refinement.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/moving.h"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// What discovery adds to FrameCounts.
struct DiscoveryCounts {
  uint64_t rays = 0, hits = 0;
  std::vector<uint64_t> segments_per_depth;
  // Of a refined launch: the share of sequences that one sample alone met, and why it ended.
  double share_once = 0;
  LaunchEnd end = LaunchEnd::recall;
};

// Transmitters that stand on no vehicle.
std::vector<Launcher> launchers(const std::vector<glm::dvec3>& transmitters);

// Every stride-th direction of the full set, from `phase` on. Neighbours of a sorted launch are stride apart.
struct DirectionShare {
  uint64_t phase = 0, stride = 1;
};

// Who launches: transmitters all of trace.rays; listeners what listen() has said, and nobody follows theirs.
enum class LaunchedBy { transmitters, listeners };

class Discovery {
 public:
  // keep_ages: see passes/sequences.hpp.
  Discovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& config, const OrderPlan& order = {},
            bool keep_ages = false);
  // Segments are asked of a cache from now on, before they are traced.
  void use_cache(const DeviceScene& scene, const CacheConfig& config, const CacheWorld& world);
  RayCache* cache() { return cache_ ? &*cache_ : nullptr; }
  // Rays of launches that are not refined are followed from now on; trails outlives this.
  void follow(RayTrails& trails);
  // So many rays a listener from now on.
  void listen(uint64_t rays);
  // Of directions = "horizon": the tables that launchers name from now on, see LaunchHeights.
  void set_heights(const std::vector<float>& tables) { heights_->set(tables); }
  // Is told of the rays that were launched; outlives this.
  void watch(const FrameWatch& watch) { watch_ = &watch; }
  // Adds to sequences() what rays from these ends meet, in these directions.
  DiscoveryCounts operator()(const DeviceScene& scene, const std::vector<Launcher>& ends, DirectionShare share = {},
                             LaunchedBy by = LaunchedBy::transmitters);
  // The same with as many rays as trace.recall asks for, at most trace.max_rays a transmitter: a launch that is refined
  // where it still finds something. Needs trace.rays = "auto".
  // frame: since the last cold one, see Refinement.
  DiscoveryCounts refined(const DeviceScene& scene, const std::vector<Launcher>& transmitters, uint64_t frame);
  Sequences& sequences() { return sequences_; }

 private:
  // A part of the launch: rays of the transmitters from launch index first (counted over all transmitters) on.
  struct Batch {
    uint64_t first, count;
  };
  // What the rays of a queue have in common: the number of their segment, from 1, and how many surfaces they may pass.
  struct Stage {
    uint32_t depth, transmissions;
  };
  void launch(const std::vector<Launcher>& transmitters, DirectionShare share, Batch batch);
  // Rays of an end in this launch.
  uint64_t rays_of(DirectionShare share) const {
    const uint64_t rays = by_ == LaunchedBy::listeners ? listener_rays_ : *config_.rays;
    return (rays - share.phase + share.stride - 1) / share.stride;
  }
  void tell(uint64_t done, uint64_t total) const {
    if (watch_) (*watch_)("rays", done, total);
  }
  void trace_level(const DeviceScene& scene, DiscoveryCounts& counts);
  // Queues get the planes that say where a ray comes from.
  void label();
  RayTrails* trails() const { return by_ == LaunchedBy::transmitters ? trails_ : nullptr; }
  // Segments of a ray, at most: one more than interactions where receptions are wanted.
  uint32_t segments() const { return depth_ + (trails() && trails()->receives()); }
  void find_hits(const DeviceScene& scene, uint32_t depth);
  // Room for batches of so many rays, in everything that holds something of each.
  void reserve(uint64_t rays);
  void trace_batch(const DeviceScene& scene, Interact& interact, DiscoveryCounts& counts,
                   const gpu::Buffer<uint32_t>* ends = nullptr);
  // rays_ and what is reflected of them. Queues of transmitted rays are left in transmitted_, and their stages, from
  // the lowest depth to the highest, in waiting.
  void trace_reflected(const DeviceScene& scene, Interact& interact, DiscoveryCounts& counts, Stage stage,
                       std::vector<Stage>& waiting, const gpu::Buffer<uint32_t>* ends);

  gpu::Context& context_;
  TraceConfig config_;
  OrderPlan plan_;
  uint32_t max_depth_, depth_;  // of sequences; interactions of a ray
  uint32_t transmissions_;      // of a ray, at most
  uint64_t batch_rays_;
  bool keep_ages_;
  TraceShape shape_;
  LaunchDirections directions_;
  std::shared_ptr<LaunchHeights> heights_;
  GenerateRays generate_;
  uint64_t listener_rays_ = 0;
  std::optional<GenerateRays> listener_generate_;  // with listeners
  Trace trace_;
  std::optional<Compact> compact_;  // where trace does not count the hits of blocks
  Scan scan_;
  Interact interact_;
  Sequences sequences_;
  std::optional<Refinement> refinement_;  // with trace.rays = "auto"
  std::optional<Interact> interact_samples_;
  std::optional<RayCache> cache_;
  std::optional<LabelRays> label_;  // with a cache or trails
  RayTrails* trails_ = nullptr;
  const FrameWatch* watch_ = nullptr;
  LaunchedBy by_ = LaunchedBy::transmitters;
  std::optional<RayOrder> order_;  // if the plan has one
  uint64_t room_ = 0;              // rays that fit into what reserve() makes
  RayQueue rays_, next_;
  std::vector<RayQueue> transmitted_;  // one a depth from 2 on, where rays are transmitted
  HitList hits_;
};

}  // namespace wavetracer
