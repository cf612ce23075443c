// SPDX-License-Identifier: Apache-2.0
// solve: exact reflection points of candidates by the image method, in double on the device.
// The list grows until it holds every solved candidate.
#pragma once
#include "kernel_calls/solve.hpp"
#include "passes/blockers.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class Solve {
 public:
  // remembers: paths that the same triangle hides as before are not listed, but counted.
  Solve(gpu::Context& context, uint32_t max_depth, bool remembers = false);
  SolvedList& operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                         const gpu::Buffer<uint32_t>& quarters, const gpu::Buffer<wt_candidate>& candidates,
                         uint32_t candidate_count, Counters& counters, const Blockers* blockers = nullptr);

 private:
  gpu::Context& context_;
  Work work_;
  bool remembers_;
  gpu::KernelOf<calls::solve::solve> kernel_;
  SolvedList solved_;
};

}  // namespace wavetracer
