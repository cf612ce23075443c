// SPDX-License-Identifier: Apache-2.0
// radix_sort: a stable sort of 32- or 64-bit keys by a range of their bits, with a 32-bit word per key or without. It
// needs one in-order queue: nothing is read back between the passes, and the device skips digits that are the same in
// all keys.
#pragma once
#include <cstddef>
#include <cstdint>

#include <variant>

#include "kernel_calls/radix_sort.hpp"
#include "kernel_calls/radix_sort_cpu.hpp"
#include "passes/payload.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

// The kernels that sort. groups (kernels/primitives/radix_sort.cl): work-groups that rank tiles in local memory, and
// read the keys once for all counts and once for each digit. chunks
// (radix_sort_cpu.cl beside it): single work-items, each for a long run of keys. lines: chunks that always collect keys
// in lines before they write them (chunks does so only for large n). device: chunks on CPUs, groups elsewhere. The
// result is the same.
enum class SortForm { device, groups, chunks, lines };

// It begins with the least significant digit. Passes move keys and values between the caller's buffers and the
// temporary one. By chunks each pass first counts the digits of every chunk and turns counts into offsets.
template <class Key>
class RadixSort {
  static_assert(sizeof(Key) == 4 || sizeof(Key) == 8);

 public:
  static constexpr unsigned key_bits = 8 * sizeof(Key);

  RadixSort(gpu::Context& context, Payload payload, SortForm form = SortForm::device);
  // The form for groups with a tuning of the caller's. Local memory must hold what it asks for: the counters of the
  // ranking or the keys of a tile; besides, with columns a byte for each key, with masks the counters once more.
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
  struct Chunks {
    RadixChunks tuning;
    gpu::KernelOf<calls::radix_sort_cpu::count> count;
    gpu::KernelOf<calls::radix_sort_cpu::offsets> offsets;
    gpu::KernelOf<calls::radix_sort_cpu::move> move;
    gpu::KernelOf<calls::radix_sort_cpu::settle> settle;
  };
  struct Groups {
    RadixTuning tuning;
    gpu::KernelOf<calls::radix_sort::clear> clear;
    gpu::KernelOf<calls::radix_sort::histogram> histogram;
    gpu::KernelOf<calls::radix_sort::starts> starts;
    gpu::KernelOf<calls::radix_sort::move> move;
    gpu::KernelOf<calls::radix_sort::settle> settle;
  };
  // The arguments of a call.
  struct Call {
    gpu::Buffer<Key>& keys;
    gpu::Buffer<uint32_t>& values;
    uint32_t n;
    gpu::Buffer<uint32_t>& temporary;
    unsigned first_bit, end_bit;
    Stage stage;
  };
  void sort(const Call& call);
  void sort_by(Chunks& chunks, const Call& call);
  void sort_by(Groups& groups, const Call& call);

  Payload payload_;
  std::variant<Chunks, Groups> form_;
};

extern template class RadixSort<uint32_t>;
extern template class RadixSort<uint64_t>;

}  // namespace wavetracer
