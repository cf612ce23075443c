// SPDX-License-Identifier: Apache-2.0
// wedge_join: candidates of diffracted paths, from prefixes of both ends that see one wedge; with wedge_pairs also from
// those that see a wedge each.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/wedge_join.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/wedge_candidates.hpp"
#include "passes/wedge_lists.hpp"
#include "passes/wedge_pairs.hpp"

namespace wavetracer {

class WedgeJoin {
 public:
  // wavelength_m: the longest one, for paths over free ends of edges.
  WedgeJoin(gpu::Context& context, uint32_t max_depth, double wavelength_m = 0);
  // prefixes: sorted by their keys; first to end - 1 of them serve as those of transmitters. pairs: for paths over two
  // wedges too, or nullptr. Returns the number of candidates, as WedgeCandidates::fill() does.
  uint32_t operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t first, uint32_t end,
                      const WedgeList& wedges, const RadioEnds& ends, WedgePairs* pairs, WedgeCandidates& into,
                      Counters& counters);

 private:
  gpu::KernelOf<calls::wedge_join::wedge_join> kernel_;
  uint32_t max_depth_, lanes_, group_;
  float end_detour_m_;
};

}  // namespace wavetracer
