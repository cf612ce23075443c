// SPDX-License-Identifier: Apache-2.0
// heard_join: candidates of diffracted paths, from what listeners have heard of edges (hear) and the transmitters'
// prefixes that see these.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/heard_join.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/tuning.hpp"
#include "passes/wedge_candidates.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

// The sequences of transmitters and listeners: nodes first to end - 1 of the list are joined.
struct HeardNodes {
  const gpu::Buffer<uint64_t>& trie;
  const gpu::Buffer<uint32_t>&quarters, &nodes;
  uint32_t first, end;
};

class HeardJoin {
 public:
  // pieces: those of an edge that wedge_sight has tested. wavelength_m: see WedgeJoin.
  HeardJoin(gpu::Context& context, uint32_t max_depth, uint32_t pieces, double wavelength_m);
  // prefixes: those of transmitters, sorted by their keys, the first in_sight of which see something. Returns the
  // number of candidates, as WedgeCandidates::fill() does.
  uint32_t operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t in_sight,
                      const HeardNodes& heard, const WedgeList& wedges, const RadioEnds& ends, WedgeCandidates& into,
                      Counters& counters);

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::heard_join::heard_join> kernel_;
  Work work_;
  uint32_t max_depth_, pieces_;
  float end_detour_m_;
};

}  // namespace wavetracer
