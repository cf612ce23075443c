// SPDX-License-Identifier: Apache-2.0
// The two sorts together, at the crossover that bench_sort measures: bitonic for few keys, radix for many.
#pragma once
#include <optional>

#include "passes/bitonic_sort.hpp"
#include "passes/radix_sort.hpp"

namespace wavetracer {

// automatic: bitonic where one launch of it sorts all keys by all of their bits, else radix.
enum class SortMethod { automatic, radix, bitonic };

// A stable sort of keys of 32 or 64 bits, by either method.
template <class Key>
class KeySort {
 public:
  static constexpr unsigned key_bits = 8 * sizeof(Key);

  KeySort(gpu::Context& context, Payload payload, SortMethod method = SortMethod::automatic);
  // The most keys that bitonic sorts in one launch; 0 for SortMethod::radix.
  uint32_t block() const { return bitonic_ ? bitonic_->block() : 0; }
  // Words of temporary memory that are enough for any n' <= n keys.
  size_t temporary_words(uint32_t n) const;
  // Throws std::invalid_argument if keys cannot be sorted by these bits, see below.
  void check_bits(unsigned first_bit, unsigned end_bit) const;
  // Sorts keys[0 .. n - 1], and values with them, by bits first_bit .. end_bit - 1. stage: the profiling sum that the
  // time is added to. Throws std::invalid_argument if a buffer is too small, if the bits are no range of the key's, or
  // if they are a part of them and the method is bitonic.
  void operator()(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n, gpu::Buffer<uint32_t>& temporary,
                  unsigned first_bit = 0, unsigned end_bit = key_bits, Stage stage = Stage::sort);
  // The same for Payload::none.
  void operator()(gpu::Buffer<Key>& keys, uint32_t n, gpu::Buffer<uint32_t>& temporary, unsigned first_bit = 0,
                  unsigned end_bit = key_bits, Stage stage = Stage::sort);

 private:
  std::optional<BitonicSort<Key>> bitonic_;
  std::optional<RadixSort<Key>> radix_;
  bool by_network(uint32_t n, unsigned first_bit, unsigned end_bit) const;
};

extern template class KeySort<uint32_t>;
extern template class KeySort<uint64_t>;

// The permutation that sorts 32-bit keys, with temporary memory of its own.
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
  gpu::Context& context_;
  KeySort<uint32_t> sort_;
  gpu::Buffer<uint32_t> temporary_;
};

}  // namespace wavetracer
