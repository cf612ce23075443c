// visible: the solved paths that occlusion has left, as a list of their own, a fraction of what was solved.
// The list grows until it holds them.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/solved_list.hpp"

namespace wavetracer {

class Visible {
 public:
  Visible(gpu::Context& context, uint32_t max_depth);
  const SolvedList& operator()(const SolvedList& solved, gpu::Buffer<wt_counters>& counters);

 private:
  gpu::Context& context_;
  gpu::Kernel kernel_;
  uint32_t local_;
  SolvedList visible_;
};

}  // namespace wavetracer
