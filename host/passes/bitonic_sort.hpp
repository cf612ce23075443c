// SPDX-License-Identifier: Apache-2.0
// bitonic_sort: a stable sort of any number of keys by Batcher's network; one launch where they fit into one block. It
// serves for small n, and as the baseline that the thesis compared with; from some blocks on radix_sort is faster.
#pragma once
#include "gpu/gpu.hpp"
#include "kernel_calls/bitonic_sort.hpp"
#include "passes/payload.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

// Key is uint32_t or uint64_t.
template <class Key>
class BitonicSort {
 public:
  // The work-items that sort a block: groups takes a work-group, vectors takes one work-item with vectors of 16 keys.
  // device: vectors on CPUs, groups elsewhere.
  enum class Form { device, groups, vectors };

  // largest_block: blocks are the largest power of two that fits into local memory, at most this; at least 16.
  BitonicSort(gpu::Context& context, Payload payload, Form form = Form::device,
              uint32_t largest_block = largest_bitonic_block);

  // The most keys that one launch sorts.
  uint32_t block() const { return block_; }
  // Words of temporary memory that a sort of n keys needs. A buffer must be given even where it is zero.
  size_t temporary_words(uint32_t n) const;
  // Sorts keys[0 .. n - 1], ascending and stable, and values[0 .. n - 1] with them (see Payload). The contents of
  // temporary are undefined afterwards.
  void operator()(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n, gpu::Buffer<uint32_t>& temporary,
                  Stage stage = Stage::sort);
  // The same for Payload::none.
  void operator()(gpu::Buffer<Key>& keys, uint32_t n, gpu::Buffer<uint32_t>& temporary, Stage stage = Stage::sort);

 private:
  Payload payload_;
  uint32_t block_, items_, step_group_;
  gpu::KernelOf<calls::bitonic_sort::sort_blocks> sort_blocks_;
  gpu::KernelOf<calls::bitonic_sort::one_step> one_step_;
  gpu::KernelOf<calls::bitonic_sort::merge_blocks> merge_blocks_;
  gpu::KernelOf<calls::bitonic_sort::gather> gather_;
  void sort(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n, gpu::Buffer<uint32_t>& temporary,
            Stage stage);
};

extern template class BitonicSort<uint32_t>;
extern template class BitonicSort<uint64_t>;

}  // namespace wavetracer
