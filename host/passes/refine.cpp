// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/discovery/refine.cl.
// A work-item takes one sample or slot.
#include "passes/refine.hpp"

namespace wavetracer {

Refine::Refine(gpu::Context& context)
    : context_(context),
      count_ends_(context),
      met_(context),
      mark_(context),
      split_(context),
      counts_(context.buffer<uint32_t>(2, "sequences met")),
      local_(context.info().simple_local_size()) {}

void Refine::count_ends(const SampleList& level, gpu::Buffer<uint32_t>& hits) {
  count_ends_({level.count, local_}, Stage::refine,
              calls::refine::count_ends{.ends = level.ends, .count = level.count, .hits = hits});
}

MetSequences Refine::met(const gpu::Buffer<uint32_t>& hits) {
  context_.fill(counts_, 0, Stage::refine);
  met_({hits.size(), local_}, Stage::refine,
       calls::refine::count_met{.hits = hits, .slots = static_cast<uint32_t>(hits.size()), .met = counts_});
  const auto counts = counts_.read(0, 2, Stage::refine);
  return {counts[0], counts[1]};
}

void Refine::mark(const SampleList& level, const gpu::Buffer<uint32_t>& hits, uint32_t rare,
                  gpu::Buffer<float>& marks) {
  mark_({level.count, local_}, Stage::refine,
        calls::refine::mark{.ends = level.ends,
                            .count = level.count,
                            .hits = hits,
                            .rare = rare,
                            .marks = gpu::Global<uint32_t>::bits_of(marks)});
}

void Refine::split(const SampleList& level, const gpu::Buffer<uint32_t>& list, uint32_t count, SampleList& next) {
  split_({count, local_}, Stage::refine,
         calls::refine::split{.list = list,
                              .count = count,
                              .samples = level.samples,
                              .capacity = level.capacity,
                              .next_samples = next.samples,
                              .next_capacity = next.capacity});
  next.count = 4 * count;
  next.level = level.level + 1;
}

}  // namespace wavetracer
