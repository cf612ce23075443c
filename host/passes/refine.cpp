// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/refine.cl.
// A work-item takes one sample or slot.
#include "passes/refine.hpp"

namespace wavetracer {

Refine::Refine(gpu::Context& context)
    : context_(context),
      count_ends_(context.kernel("refine", "count_ends")),
      met_(context.kernel("refine", "count_met")),
      mark_(context.kernel("refine", "mark")),
      split_(context.kernel("refine", "split")),
      counts_(context.buffer<uint32_t>(2, "sequences met")),
      local_(context.info().simple_local_size()) {}

void Refine::count_ends(const SampleList& level, gpu::Buffer<uint32_t>& hits) {
  count_ends_({level.count, local_}, Stage::refine, level.ends, level.count, hits);
}

MetSequences Refine::met(const gpu::Buffer<uint32_t>& hits) {
  context_.fill(counts_, 0, Stage::refine);
  met_({hits.size(), local_}, Stage::refine, hits, static_cast<uint32_t>(hits.size()), counts_);
  const auto counts = counts_.read(0, 2, Stage::refine);
  return {counts[0], counts[1]};
}

void Refine::mark(const SampleList& level, const gpu::Buffer<uint32_t>& hits, uint32_t rare,
                  gpu::Buffer<float>& marks) {
  mark_({level.count, local_}, Stage::refine, level.ends, level.count, hits, rare, marks);
}

void Refine::split(const SampleList& level, const gpu::Buffer<uint32_t>& list, uint32_t count, SampleList& next) {
  split_({count, local_}, Stage::refine, list, count, level.samples, level.capacity, next.samples, next.capacity);
  next.count = 4 * count;
  next.level = level.level + 1;
}

}  // namespace wavetracer
