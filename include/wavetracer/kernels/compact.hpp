// SPDX-License-Identifier: Apache-2.0
// Compact: the indices of the words that are not `nothing`, in ascending order. It needs neither double precision nor
// 64-bit atomics, and the host reads nothing back.
#pragma once
#include "wavetracer/kernels/context.hpp"

namespace wavetracer::kernels {

// The word that Compact leaves out. Passes of the suite write it where there is nothing: no hit, no entry, no parent.
constexpr uint32_t nothing = 0xffffffffu;

// Cost: 3 launches (4 for many words); 8 n bytes and 4 bytes for each index are moved. The object keeps 4 bytes for
// each block of words (128 on GPUs, 16 on CPUs).
class Compact {
 public:
  struct State;  // the suite alone knows it
  explicit Compact(const Context& context);
  ~Compact();
  Compact(Compact&&) noexcept;
  Compact& operator=(Compact&&) noexcept;

  // Writes the indices i < n with words[i] != nothing to indices[0 .. total[0] - 1], and their number to total[0].
  // indices must have room for n, since their number is known on the device alone; what lies behind them stays. n is at
  // most 2^32 - 1. Throws Error if a buffer is too short or of another context.
  void operator()(const Buffer<uint32_t>& words, size_t n, const Buffer<uint32_t>& indices,
                  const Buffer<uint32_t>& total, const Call& call = {});
  // Makes the memory that the object keeps large enough for n words, so that calls allocate nothing.
  void reserve(size_t n);

 private:
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::kernels
