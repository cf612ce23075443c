// SPDX-License-Identifier: Apache-2.0
// visible: the solved paths that occlusion has left, as a list of their own, a fraction of all solved paths: those of
// all kinds, one after the other. The list grows until it holds them.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/visible.hpp"
#include "passes/counters.hpp"
#include "passes/solved_list.hpp"

namespace wavetracer {

class Visible {
 public:
  Visible(gpu::Context& context, uint32_t max_depth);
  // Empties the list; its counter is zero, too.
  void clear() { visible_.count = 0; }
  // Appends the visible paths of `solved`.
  void operator()(const SolvedList& solved, Counters& counters);
  SolvedList& list() { return visible_; }

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::visible::visible> kernel_;
  uint32_t local_;
  SolvedList visible_;
};

}  // namespace wavetracer
