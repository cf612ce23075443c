// Host side of kernels/compact.cl.
// A work-item of a CPU takes 64 blocks in turn, as in interact.
#include "passes/compact.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace wavetracer {

namespace {
constexpr uint32_t blocks_per_item = 64;
}

Compact::Compact(gpu::Context& context, uint32_t block, Form form) : block_(block) {
  const bool items = form == Form::device ? context.info().cpu : form == Form::items;
  if (block == 0 || (!items && (block % 32 != 0 || block > context.info().max_work_group)))
    throw std::invalid_argument(fmt::format("compact: blocks of {} words", block));
  gpu::Definitions definitions = {{"WT_BLOCK", std::to_string(block) + "u"}};
  if (items) definitions["WT_BLOCKS_PER_ITEM"] = std::to_string(blocks_per_item);
  count_blocks_ = context.kernel("compact", "count_blocks", definitions);
  compact_ = context.kernel("compact", "compact", definitions);
  words_per_item_ = items ? block * blocks_per_item : 1;
  local_ = items ? 4 : block;
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
  count_blocks_({(size_t{count} + words_per_item_ - 1) / words_per_item_, local_}, "compact", words, uint64_t{first},
                count, block_counts);
}

void Compact::operator()(const gpu::Buffer<float>& words, size_t first, uint32_t count,
                         const gpu::Buffer<uint32_t>& block_offsets, gpu::Buffer<uint32_t>& indices) {
  check(words, first, count, block_offsets);
  compact_({(size_t{count} + words_per_item_ - 1) / words_per_item_, local_}, "compact", words, uint64_t{first}, count,
           block_offsets, indices);
}

}  // namespace wavetracer
