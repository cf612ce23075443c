// SPDX-License-Identifier: Apache-2.0
// radix_sort: a stable sort of 32- or 64-bit keys by a range of their bits, with a 32-bit word per key or without. It
// needs one in-order queue: nothing is read back between the passes, and the device skips digits that are the same in
// all keys.
#pragma once
#include <cstddef>
#include <cstdint>

#include "kernel_calls/radix_sort.hpp"
#include "passes/payload.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

// The kernels that sort. groups (kernels/primitives/radix_sort.cl): work-groups that rank tiles in local memory. chunks
// (radix_sort_cpu.cl beside it): single work-items, each for a long run of keys. lines: chunks that always collect keys
// in lines before they write them (chunks does so only for large n). device: chunks on CPUs, groups elsewhere. The
// result is the same.
enum class SortForm { device, groups, chunks, lines };

// It begins with the least significant digit: a pass counts the digits of every chunk of keys, turns counts into
// offsets, and moves keys and values between the caller's buffers and the temporary one.
template <class Key>
class RadixSort {
  static_assert(sizeof(Key) == 4 || sizeof(Key) == 8);

 public:
  static constexpr unsigned key_bits = 8 * sizeof(Key);

  RadixSort(gpu::Context& context, Payload payload, SortForm form = SortForm::device);
  // The form for groups with a tuning of the caller's. Local memory must hold what it asks for: the counters of the
  // columns or the keys of a tile (with `together` their values, too), and a byte for each key.
  RadixSort(gpu::Context& context, Payload payload, const RadixTuning& groups);

  // Words of temporary memory that n keys need.
  size_t temporary_words(uint32_t n) const;

  // Sorts keys[0 .. n - 1], and values with them, by bits first_bit .. end_bit - 1 of the keys; equal ones keep their
  // order. Elements from n on stay. stage: the profiling sum that the time is added to. Throws std::invalid_argument if
  // a buffer is too small or the bits are no range of the key's.
  void operator()(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n, gpu::Buffer<uint32_t>& temporary,
                  unsigned first_bit = 0, unsigned end_bit = key_bits, Stage stage = Stage::sort);
  // The same for Payload::none; with any other it is a std::logic_error.
  void operator()(gpu::Buffer<Key>& keys, uint32_t n, gpu::Buffer<uint32_t>& temporary, unsigned first_bit = 0,
                  unsigned end_bit = key_bits, Stage stage = Stage::sort);

 private:
  void make_kernels(gpu::Context& context, const char* program, gpu::Definitions definitions);
  uint32_t chunk_of(uint32_t n) const;
  void sort(gpu::Buffer<Key>& keys, gpu::Buffer<uint32_t>& values, uint32_t n, gpu::Buffer<uint32_t>& temporary,
            unsigned first_bit, unsigned end_bit, Stage stage);

  Payload payload_;
  RadixTuning tuning_;
  gpu::KernelOf<calls::radix_sort::count> count_;
  gpu::KernelOf<calls::radix_sort::offsets> offsets_;
  gpu::KernelOf<calls::radix_sort::move> move_;
  gpu::KernelOf<calls::radix_sort::settle> settle_;
};

extern template class RadixSort<uint32_t>;
extern template class RadixSort<uint64_t>;

}  // namespace wavetracer
