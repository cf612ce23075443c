// SPDX-License-Identifier: Apache-2.0
// refine: selects the samples of a launch that are worth four more each, and makes those four. Sequences are counted
// over all levels of a launch, so those that are met often are soon not refined any more.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/refine.hpp"
#include "passes/sample_list.hpp"

namespace wavetracer {

// The number of sequences in which samples ended: those with a single sample, and all.
struct MetSequences {
  uint32_t once = 0, all = 0;
};

class Refine {
 public:
  explicit Refine(gpu::Context& context);
  // Adds to hits[n] the samples of the level that ended in sequence n.
  void count_ends(const SampleList& level, gpu::Buffer<uint32_t>& hits);
  MetSequences met(const gpu::Buffer<uint32_t>& hits);
  // Sets marks[i] to i where sample i is to be refined, because at most `rare` samples have the same end; WT_NONE
  // elsewhere.
  void mark(const SampleList& level, const gpu::Buffer<uint32_t>& hits, uint32_t rare, gpu::Buffer<float>& marks);
  // Writes the cells of the listed samples, each divided by four, as the first 4 * count samples of `next`.
  void split(const SampleList& level, const gpu::Buffer<uint32_t>& list, uint32_t count, SampleList& next);

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::refine::count_ends> count_ends_;
  gpu::KernelOf<calls::refine::count_met> met_;
  gpu::KernelOf<calls::refine::mark> mark_;
  gpu::KernelOf<calls::refine::split> split_;
  gpu::Buffer<uint32_t> counts_;
  uint32_t local_;
};

}  // namespace wavetracer
