// refine: which samples of a launch are worth four more each, and those four.
// Sequences are counted over all levels of a launch, so what is met often stops being refined by itself.
#pragma once
#include "gpu/gpu.hpp"
#include "passes/sample_list.hpp"

namespace wavetracer {

// Sequences in which samples ended: those met by one sample alone, and all of them.
struct MetSequences {
  uint32_t once = 0, all = 0;
};

class Refine {
 public:
  explicit Refine(gpu::Context& context);
  // hits[n] += the samples of the level that ended in sequence n.
  void count_ends(const SampleList& level, gpu::Buffer<uint32_t>& hits);
  MetSequences met(const gpu::Buffer<uint32_t>& hits);
  // marks[i] = i where sample i is to be refined, because at most `rare` samples end as it does; WT_NONE elsewhere.
  void mark(const SampleList& level, const gpu::Buffer<uint32_t>& hits, uint32_t rare, gpu::Buffer<float>& marks);
  // The cells of the listed samples, in four, as the first 4 * count samples of `next`.
  void split(const SampleList& level, const gpu::Buffer<uint32_t>& list, uint32_t count, SampleList& next);

 private:
  gpu::Context& context_;
  gpu::Kernel count_ends_, met_, mark_, split_;
  gpu::Buffer<uint32_t> counts_;
  uint32_t local_;
};

}  // namespace wavetracer
