// visible: the solved paths that occlusion has left, as a list of their own, a fraction of what was solved: those of
// all kinds, one after the other. The list grows until it holds them.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/counters.hpp"
#include "passes/solved_list.hpp"

namespace wavetracer {

class Visible {
 public:
  Visible(gpu::Context& context, uint32_t max_depth);
  // The list begins with nothing, as its counter does.
  void clear() { visible_.count = 0; }
  // Appends those of `solved`.
  void operator()(const SolvedList& solved, Counters& counters);
  SolvedList& list() { return visible_; }

 private:
  gpu::Context& context_;
  gpu::Kernel kernel_;
  uint32_t local_;
  SolvedList visible_;
};

}  // namespace wavetracer
