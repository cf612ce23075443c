// SPDX-License-Identifier: Apache-2.0
// Sort: the permutation that sorts 32-bit keys, stable; bitonic for few keys, radix for many.
// The two sorts together, at the crossover that bench_sort measures.
#pragma once
#include "passes/bitonic_sort.hpp"
#include "passes/radix_sort.hpp"

namespace wavetracer {

class Sort {
 public:
  explicit Sort(gpu::Context& context);
  // Makes its temporary memory large enough for up to n keys; the sorts do so by themselves if it is not.
  void reserve(uint32_t n);
  // stage: the profiling sum that the time is added to. Sorts keys[0 .. n - 1] by their lowest `bits` bits; higher bits
  // must be zero. order[i] becomes the place that the i-th key had. Buffers may be longer than n.
  void operator()(gpu::Buffer<uint32_t>& keys, gpu::Buffer<uint32_t>& order, uint32_t n, unsigned bits,
                  Stage stage = Stage::sort);

 private:
  size_t words(uint32_t n) const;  // words of temporary memory for up to n keys

  gpu::Context& context_;
  BitonicSort<uint32_t> bitonic_;
  RadixSort<uint32_t> radix_;
  gpu::Buffer<uint32_t> temporary_;
};

}  // namespace wavetracer
