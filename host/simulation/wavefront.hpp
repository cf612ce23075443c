// SPDX-License-Identifier: Apache-2.0
// Follows the rays of a batch to their ends: all of them at once where only reflection happens on their way (bounces),
// else by the wavefront loop, in which all rays take a step together, until none is left. A step is sort, find hits,
// scan, interact; the host reads one number at each depth, that of the rays that go on. With transmission rays split
// where they hit: queues of transmitted rays are traced depth first, so that at most one waits at each depth.
#pragma once
#include <optional>
#include <vector>

#include "passes/bounces.hpp"
#include "passes/interact.hpp"
#include "passes/scan.hpp"
#include "passes/sequences.hpp"
#include "simulation/hit_finder.hpp"
#include "simulation/launch.hpp"
#include "simulation/ray_source.hpp"
#include "simulation/tracing_depth.hpp"

namespace wavetracer {

class Wavefront {
 public:
  // options: those of interact; samples says whether rays may carry them (a refined launch). at_once: no pass needs the
  // queues of later depths. source, finder and sequences outlive this.
  Wavefront(gpu::Context& context, const DeviceScene& scene, const TracingDepth& depth, InteractOptions options,
            bool at_once, RaySource& source, HitFinder& finder, Sequences& sequences);
  // Makes room for batches of this many rays, in queues only.
  void reserve(uint64_t rays);
  // The launch rays of a batch, which are filled in before it is traced.
  RayQueue& rays() { return rays_; }
  // The most segments of a ray.
  uint32_t segments(const RayFollower& follower) const { return depth_.interactions + follower.extra_segments(); }
  // Traces the rays to their ends. ends: for a refined launch, where each sample ended. Returns false if the set of
  // sequences was too small: the batch must be traced again with a larger one.
  bool trace(const DeviceScene& scene, RayFollower& follower, DiscoveryCounts& counts,
             const gpu::Buffer<uint32_t>* ends = nullptr);

 private:
  // The common data of the rays of a queue: the number of their segment, from 1, and how many surfaces they may pass.
  struct Waiting {
    uint32_t depth, transmissions;
  };
  bool trace_at_once(const DeviceScene& scene, Bounces& bounces, const gpu::Buffer<uint32_t>* ends,
                     DiscoveryCounts& counts);
  // The queue and what is reflected of it. Queues of transmitted rays are left in transmitted_, and what they have in
  // common, from the lowest depth to the highest, in waiting_.
  void trace_reflected(const DeviceScene& scene, RayFollower& follower, DiscoveryCounts& counts, Waiting from,
                       const gpu::Buffer<uint32_t>* ends);

  gpu::Context& context_;
  TracingDepth depth_;
  uint32_t planes_;
  RaySource& source_;
  HitFinder& finder_;
  Sequences& sequences_;
  Scan scan_;
  Interact interact_;
  std::optional<Interact> interact_samples_;
  std::optional<Bounces> bounces_, bounces_samples_;
  RayQueue rays_, next_;
  std::vector<RayQueue> transmitted_;  // for each depth from 2 on, where rays are transmitted
  std::vector<Waiting> waiting_;
  HitList hits_;
};

}  // namespace wavetracer
