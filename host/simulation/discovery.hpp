// Discovery: launches rays from every transmitter and collects the distinct sequences of surfaces that they meet.
// Launches are cut into batches, which bound the memory, whatever the number of rays; a batch whose sequences do not
// fit grows the set and is traced again.
#pragma once
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
  HitFinder* finder = nullptr;        // a ray cache; not given: rays are traced
  RayFollower* follower = nullptr;    // of the launches that are followed
  const FrameWatch* watch = nullptr;  // gets the number of launched rays
  bool hilly = false;                 // see Refinement
};

class Discovery {
 public:
  Discovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& trace,
            const DiscoveryOptions& options = {});
  // Of directions = "horizon": the tables that launchers name from now on, see LaunchHeights.
  void set_heights(const std::vector<float>& tables) { source_.set_heights(tables); }
  // Adds to sequences() what the rays of this launch meet.
  DiscoveryCounts find(const DeviceScene& scene, const Launch& launch);
  // The same of several launches, which share a batch where they fit into one and nobody follows them.
  DiscoveryCounts find_all(const DeviceScene& scene, std::span<const Launch> launches);
  // The same with as many rays as trace.recall asks for, at most trace.max_rays for each launcher: a launch that is
  // refined where it still finds something. Needs trace.rays = 0 ("auto"). frame: since the last cold one, see
  // Refinement.
  DiscoveryCounts find_refined(const DeviceScene& scene, const std::vector<Launcher>& who, uint64_t frame);
  Sequences& sequences() { return sequences_; }

 private:
  DiscoveryCounts nothing_yet(RayFollower& follower) const;
  // Rays that `fill` appends to the empty queue, traced again where the set of sequences must grow for what they meet.
  template <class Fill>
  void trace_batch(const DeviceScene& scene, RayFollower& follower, DiscoveryCounts& counts, const Fill& fill);
  // False if the set of sequences must grow, and the launch begin again.
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
  std::optional<TracedHits> traced_;  // if no finder was given
  HitFinder& finder_;
  Sequences sequences_;
  Wavefront wavefront_;
  std::optional<Refinement> refinement_;  // with trace.rays = "auto"
  uint64_t room_ = 0;                     // rays that fit into what reserve() makes
};

}  // namespace wavetracer
