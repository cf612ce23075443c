// SPDX-License-Identifier: Apache-2.0
// Discovery: launches rays from every transmitter and collects the distinct sequences of surfaces that they meet.
// Launches are cut into batches, which limit the memory for any number of rays; a batch whose sequences do not fit
// grows the set and is traced again.
#pragma once
#include <functional>
#include <optional>
#include <span>

#include "simulation/frame_watch.hpp"
#include "simulation/refinement.hpp"
#include "simulation/wavefront.hpp"

namespace wavetracer {

// The inputs of a discovery besides the configuration; the objects that it refers to must outlive it.
struct DiscoveryOptions {
  OrderPlan order = {};
  bool keep_ages = false;             // see passes/sequences.hpp
  HitFinder* finder = nullptr;        // a ray cache; null: rays are traced
  RayFollower* follower = nullptr;    // follows the launches that are followed
  const FrameWatch* watch = nullptr;  // gets the number of launched rays
  bool hilly = false;                 // see Refinement
};

class Discovery {
 public:
  Discovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& trace,
            const DiscoveryOptions& options = {});
  // Sets the tables for directions = "horizon" that launchers name from now on, see LaunchHeights.
  void set_heights(const std::vector<float>& tables) { source_.set_heights(tables); }
  // Adds the sequences that the rays of this launch meet to sequences().
  DiscoveryCounts find(const DeviceScene& scene, const Launch& launch);
  // The same for several launches, which share a batch if they fit into one and are not followed.
  DiscoveryCounts find_all(const DeviceScene& scene, std::span<const Launch> launches);
  // The same with as many rays as trace.recall asks for, at most trace.max_rays for each launcher: the launch is
  // refined where it still finds something. trace.rays must be "auto" (without a number). frame: the number of
  // frames since the last cold one, see Refinement.
  DiscoveryCounts find_refined(const DeviceScene& scene, const std::vector<Launcher>& who, uint64_t frame);
  // Traces `total` rays that fill(queue, first, count) puts into the empty queue, batch by batch. done: called after a
  // batch; returns false if the batch must be traced again.
  DiscoveryCounts find_filled(const DeviceScene& scene, uint64_t total,
                              const std::function<void(RayQueue&, uint64_t, uint32_t)>& fill,
                              const std::function<bool()>& done);
  Sequences& sequences() { return sequences_; }

 private:
  DiscoveryCounts nothing_yet(RayFollower& follower) const;
  // Traces the rays that `fill` appends to the empty queue, again if the set of sequences must grow for them.
  template <class Fill>
  void trace_batch(const DeviceScene& scene, RayFollower& follower, DiscoveryCounts& counts, const Fill& fill);
  // Returns false if the set of sequences must grow, and the launch must begin again.
  bool trace_level(const DeviceScene& scene, DiscoveryCounts& counts);
  // Makes room for batches of this many rays, in all buffers with an entry per ray.
  void reserve(uint64_t rays);
  void tell(uint64_t done, uint64_t total) const {
    if (watch_) watch_->tell("rays", done, total);
  }

  TracingDepth depth_;
  RayFollower nobody_;
  RayFollower& follower_;
  const FrameWatch* watch_;
  uint64_t batch_rays_;
  RaySource source_;
  std::optional<TracedHits> traced_;  // set if no finder was given
  HitFinder& finder_;
  Sequences sequences_;
  Wavefront wavefront_;
  std::optional<Refinement> refinement_;  // set with trace.rays = "auto"
  uint64_t room_ = 0;                     // rays that the buffers of reserve() have room for
};

}  // namespace wavetracer
