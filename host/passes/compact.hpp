// SPDX-License-Identifier: Apache-2.0
// compact: the indices of the words that are not WT_NONE, in order: those of rays that hit, or of lanes that live.
// Between its two operations the block counts are scanned (see scan), which also gives the number of indices.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/compact.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

class Compact {
 public:
  // The work-items that take the words: a work-group per block, or a work-item for many blocks. device: items on CPUs,
  // groups elsewhere.
  enum class Form { device, groups, items };

  // Makes blocks as long as those of rays.
  explicit Compact(gpu::Context& context) : Compact(context, tuning_of(context.info()).block) {}
  // block: words per block; for groups a multiple of 32 that a work-group can have.
  Compact(gpu::Context& context, uint32_t block, Form form = Form::device);

  // The number of blocks of this many words, for which there must be room.
  uint32_t blocks(uint32_t words) const { return words / block_ + (words % block_ != 0); }

  // block_counts[b] becomes the number of words != WT_NONE (bit pattern) in block b of words[first .. first + count -
  // 1], the last of which may be incomplete.
  void count_blocks(const gpu::Buffer<float>& words, size_t first, uint32_t count, gpu::Buffer<uint32_t>& block_counts);
  // Writes the indices, counted from `first`, of the words != WT_NONE, ascending. block_offsets: the scanned counts;
  // indices has room for their total.
  void operator()(const gpu::Buffer<float>& words, size_t first, uint32_t count,
                  const gpu::Buffer<uint32_t>& block_offsets, gpu::Buffer<uint32_t>& indices);

 private:
  gpu::KernelOf<calls::compact::count_blocks> count_blocks_;
  gpu::KernelOf<calls::compact::compact> compact_;
  uint32_t block_;
  Work work_;
  void check(const gpu::Buffer<float>& words, size_t first, uint32_t count, const gpu::Buffer<uint32_t>& blocks) const;
};

}  // namespace wavetracer
