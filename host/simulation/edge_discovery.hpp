// SPDX-License-Identifier: Apache-2.0
// Discovery of diffracted paths from their edges (trace.edge_rays): rays leave the edges that transmitters see, and
// listeners hear what they have met. So the number of rays does not grow with that of receivers.
#pragma once
#include "passes/edge_rays.hpp"
#include "passes/hear.hpp"
#include "simulation/discovery.hpp"
#include "simulation/listeners.hpp"

namespace wavetracer {

class EdgeDiscovery final : public RayFollower {
 public:
  // trace: with edge_rays. origins: with squares. scene and watch outlive this.
  EdgeDiscovery(gpu::Context& context, const DeviceScene& scene, const TraceConfig& trace, const Origins& origins,
                const FrameWatch& watch);
  // Adds the sequences that listeners hear to `into`, whose first `listed` nodes() stay the same. prefixes: those of
  // transmitters, sorted, the first in_sight of which see something of their edges.
  DiscoveryCounts find(const DeviceScene& scene, const WedgePrefixList& prefixes, const WedgeList& wedges,
                       uint32_t in_sight, uint32_t listed, Sequences& into);

  uint32_t extra_segments() const override { return 1; }  // to the listeners
  void follow(const RayQueue& rays, const HitList& hits, uint32_t depth,
              const std::optional<AnsweredRays>& answered) override;

 private:
  ListenerMap map_;
  EdgeRays edge_rays_;
  Hear hear_;
  uint32_t max_depth_;
  Discovery discovery_;
  Sequences* into_ = nullptr;
};

}  // namespace wavetracer
