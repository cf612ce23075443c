// SPDX-License-Identifier: Apache-2.0
// target_edges: candidates of ways over one edge to points of targets, from the prefixes of all ends that see the edge.
#pragma once
#include <cstdint>

#include "kernel_calls/target_edges.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/targets.hpp"
#include "passes/wedge_candidates.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

class TargetEdges {
 public:
  // interactions: the most of a way, its edge included. wavelength_m: the longest one, for ways over free ends of
  // edges.
  TargetEdges(gpu::Context& context, uint32_t interactions, double wavelength_m);
  // prefixes: sorted by their keys; those from first to end - 1 are taken. ends: those that launch, with the points as
  // receivers, and with the links that are wanted. The receiver of a candidate is the number of its point. Returns the
  // number of candidates, as WedgeCandidates::fill() does.
  uint32_t operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t first, uint32_t end,
                      const WedgeList& wedges, const RadioEnds& ends, const TargetRows& targets, WedgeCandidates& into,
                      Counters& counters);

 private:
  gpu::KernelOf<calls::target_edges::target_edges> kernel_;
  uint32_t interactions_, lanes_, group_;
  float end_detour_m_;
};

}  // namespace wavetracer
