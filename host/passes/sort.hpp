// Sort: the permutation that sorts 32-bit keys, stable; bitonic for few keys, radix for many.
// The two sorts together, at the crossover that bench_sort measures.
#pragma once
#include "passes/bitonic_sort.hpp"
#include "passes/radix_sort.hpp"

namespace wavetracer {

class Sort {
 public:
  explicit Sort(gpu::Context& context);
  // Words of temporary memory that up to n keys need.
  size_t temporary_words(uint32_t n) const;
  // Sorts keys[0 .. n - 1] by their lowest `bits` bits, above which they must be zero; order[i] becomes the place that
  // the i-th had. Buffers may be longer than n.
  void operator()(gpu::Buffer<uint32_t>& keys, gpu::Buffer<uint32_t>& order, uint32_t n,
                  gpu::Buffer<uint32_t>& temporary, unsigned bits);

 private:
  BitonicSort<uint32_t> bitonic_;
  RadixSort<uint32_t> radix_;
  uint32_t bitonic_most_;
};

}  // namespace wavetracer
