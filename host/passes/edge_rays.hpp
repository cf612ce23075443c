// SPDX-License-Identifier: Apache-2.0
// edge_rays: rays from the edges that transmitters see, along the cones of their diffracted waves.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/edge_rays.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

class EdgeRays {
 public:
  // each: the rays of every prefix. pieces: those of an edge in the masks of prefixes. roots: the root of a ray's
  // sequence is this number and that of its edge. Receivers are between low_m and high_m, and most rays do not lead
  // away from there.
  EdgeRays(gpu::Context& context, uint32_t each, uint32_t pieces, uint32_t roots, float low_m, float high_m);
  // Puts the rays first to first + count - 1 of all prefixes, in the order of prefixes.sorted, into the queue. Those
  // prefixes must see something of their edges.
  void operator()(RayQueue& queue, const WedgePrefixList& prefixes, const WedgeList& wedges, uint64_t first,
                  uint32_t count);
  // The number of rays of so many prefixes.
  uint64_t total(uint32_t prefixes) const { return uint64_t{prefixes} * each_; }

 private:
  gpu::KernelOf<calls::edge_rays::edge_rays> kernel_;
  Work work_;
  uint32_t each_, pieces_, roots_;
  float low_m_, high_m_;
};

}  // namespace wavetracer
