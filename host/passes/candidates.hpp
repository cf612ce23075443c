// SPDX-License-Identifier: Apache-2.0
// candidates: pairs of sequences and receivers that may have a path, after two conservative rejections.
// The list grows until it holds all of them.
#pragma once
#include "kernel_calls/candidates.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class Candidates {
 public:
  // max_reflections: longer sequences give no paths.
  explicit Candidates(gpu::Context& context, uint32_t max_reflections = WT_MAX_DEPTH);
  // nodes: roots first, then trie nodes. Returns the number of candidates in list(), or a bound of it.
  uint32_t operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                      const gpu::Buffer<uint32_t>& nodes, uint32_t node_count, Counters& counters);
  gpu::Buffer<wt_candidate>& list() { return list_; }

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::candidates::candidates> kernel_;
  uint32_t max_reflections_;
  Work work_;
  gpu::Buffer<wt_candidate> list_;
};

}  // namespace wavetracer
