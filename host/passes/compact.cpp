// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/primitives/compact.cl.
// It checks its arguments, since callers name ranges of planes.
#include "passes/compact.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace wavetracer {

Compact::Compact(gpu::Context& context, uint32_t block, Form form) : block_(block) {
  const Tuning tuning = tuning_of(context.info());
  const bool items = form == Form::device ? tuning.alone : form == Form::items;
  if (block == 0 || (!items && (block % 32 != 0 || block > context.info().max_work_group)))
    throw std::invalid_argument(fmt::format("compact: blocks of {} words", block));
  gpu::Definitions definitions = {{"WT_BLOCK", std::to_string(block) + "u"}};
  if (items) definitions["WT_BLOCKS_PER_ITEM"] = std::to_string(tuning.blocks_per_item);
  count_blocks_ = {context, definitions};
  compact_ = {context, definitions};
  work_ = items ? Work{block * tuning.blocks_per_item, 4} : Work{1, block};
}

void Compact::check(const gpu::Buffer<float>& words, size_t first, uint32_t count,
                    const gpu::Buffer<uint32_t>& blocks) const {
  if (first > words.size() || count > words.size() - first)
    throw std::invalid_argument(fmt::format("compact: words {} to {} of {}", first, first + count, words.size()));
  const uint64_t needed = (uint64_t{count} + block_ - 1) / block_;
  if (needed > blocks.size())
    throw std::invalid_argument(fmt::format("compact: {} blocks in a buffer of {}", needed, blocks.size()));
}

void Compact::count_blocks(const gpu::Buffer<float>& words, size_t first, uint32_t count,
                           gpu::Buffer<uint32_t>& block_counts) {
  check(words, first, count, block_counts);
  count_blocks_(work_.range(count), Stage::compact,
                calls::compact::count_blocks{
                    .planes = words, .first = uint64_t{first}, .count = count, .block_counts = block_counts});
}

void Compact::operator()(const gpu::Buffer<float>& words, size_t first, uint32_t count,
                         const gpu::Buffer<uint32_t>& block_offsets, gpu::Buffer<uint32_t>& indices) {
  check(words, first, count, block_offsets);
  compact_(work_.range(count), Stage::compact,
           calls::compact::compact{.planes = words,
                                   .first = uint64_t{first},
                                   .count = count,
                                   .block_offsets = block_offsets,
                                   .indices = indices});
}

}  // namespace wavetracer
