// SPDX-License-Identifier: Apache-2.0
// Sort: sorts keys of 32 or 64 bits in ascending order, stable, alone or with a 32-bit word per key. It needs neither
// double precision nor 64-bit atomics. The result is the same on every device and with either method.
//
//   kernels::Sort sort(context, {.key_bits = 64, .payload = kernels::Payload::index});
//   sort(keys, order, n);
#pragma once
#include "wavetracer/kernels/context.hpp"

namespace wavetracer::kernels {

// The data that move with the keys. none: no data. words: a word per key. index: the sort writes the words itself:
// values[i] becomes the place that the i-th smallest key had, so the values are the permutation that sorts.
enum class Payload { none, words, index };

// radix: least significant digit first, for any range of bits. bitonic: Batcher's network, by whole keys. automatic:
// bitonic where one launch of it sorts them all (up to 8192 keys, less where local memory is small), else radix.
enum class SortMethod { automatic, radix, bitonic };

struct SortOptions {
  unsigned key_bits = 32;  // 32 or 64
  Payload payload = Payload::none;
  SortMethod method = SortMethod::automatic;
};

// Keys are compared by bits first_bit .. end_bit - 1, where bit 0 is the lowest. end_bit = 0 stands for all bits above.
// Keys that are equal in them keep their order. Fewer bits cost less: the radix sort takes one pass for each 8 bits.
struct BitRange {
  unsigned first_bit = 0, end_bit = 0;
};

// Cost. n keys of k bytes with payloads of v bytes (0 or 4):
// - radix: 3 launches for each 8 bits or part of them, and 1 more; each 8 bits move n * (3 k + 2 v) bytes, but digits
// that
//   are the same in all keys n * k only; if an odd number of digits moved, n * 2 (k + v) more.
// - bitonic: 1 launch up to block() keys; else about log2(n / block())^2 / 2 launches, which move n * 2 (k + v) bytes
// each. Temporary memory: see temporary_words().
class Sort {
 public:
  struct State;  // the suite alone knows it
  // Throws Error if the options are none, or if the kernels do not build.
  Sort(const Context& context, const SortOptions& options);
  ~Sort();
  Sort(Sort&&) noexcept;
  Sort& operator=(Sort&&) noexcept;

  // Sorts keys[0 .. n - 1], and values[0 .. n - 1] with them; elements from n on stay. n is at most 2^32 - 1. keys and
  // values must not overlap. Throws Error if a buffer is too short, of another context or of another kind than the
  // options say, or if the bits are no range of the key's or a part of them for the bitonic method; nothing is enqueued
  // then.
  void operator()(const Buffer<uint32_t>& keys, const Buffer<uint32_t>& values, size_t n, BitRange bits = {},
                  const Call& call = {});
  void operator()(const Buffer<uint64_t>& keys, const Buffer<uint32_t>& values, size_t n, BitRange bits = {},
                  const Call& call = {});
  // The same for Payload::none.
  void operator()(const Buffer<uint32_t>& keys, size_t n, BitRange bits = {}, const Call& call = {});
  void operator()(const Buffer<uint64_t>& keys, size_t n, BitRange bits = {}, const Call& call = {});

  // 32-bit words of temporary memory that a sort of up to n keys needs: for radix about n * (k + v) / 4, and 1 to 7% of
  // n more for counts; for bitonic 2 n with Payload::words above block() keys, else none.
  size_t temporary_words(size_t n) const;
  // Makes the temporary memory that the object keeps large enough for n keys. Without it the first sort of so many keys
  // does so; from then on calls allocate nothing.
  void reserve(size_t n);
  // From now on the object uses this memory of the caller's instead of its own, which it frees; a sort that needs more
  // throws Error. Its contents change with every sort. An empty Buffer returns to memory of the object's own.
  void use_temporary(const Buffer<uint32_t>& memory);
  // The most keys that the bitonic method sorts in one launch.
  size_t block() const;

 private:
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::kernels
