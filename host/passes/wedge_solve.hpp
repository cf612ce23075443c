// SPDX-License-Identifier: Apache-2.0
// wedge_solve: exact points of diffracted paths, on their edges and in their surfaces, in double on the device.
// The list grows until it holds every solved candidate.
#pragma once
#include "kernel_calls/wedge_solve.hpp"
#include "passes/bend_floors.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/link_limits.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/tuning.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

class WedgeSolve {
 public:
  // wavelength_m: the longest; waves of corners that are too faint for it are left out (kernels/lib/wedge.clh), none if
  // it is infinite. Paths surely below the floors are left out.
  WedgeSolve(gpu::Context& context, uint32_t max_depth, double wavelength_m, BendFloors floors = {});
  // limits: the floors of links, or null; it counts what their paths that are left out have.
  SolvedList& operator()(const DeviceScene& scene, const WedgeList& wedges, const RadioEnds& ends,
                         const gpu::Buffer<uint64_t>& trie, const gpu::Buffer<wt_wedge_candidate>& candidates,
                         uint32_t candidate_count, Counters& counters, const LinkLimits* limits = nullptr);

 private:
  gpu::Context& context_;
  Work work_;
  gpu::KernelOf<calls::wedge_solve::wedge_solve> kernel_;
  SolvedList solved_;
  float wavelength_m_;
  BendFloors floors_;
};

}  // namespace wavetracer
