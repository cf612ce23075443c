// SPDX-License-Identifier: Apache-2.0
// Scan: exclusive prefix sums of 32-bit words, in place, modulo 2^32. It needs neither double precision nor 64-bit
// atomics, and the host reads nothing back.
#pragma once
#include "wavetracer/kernels/context.hpp"

namespace wavetracer::kernels {

// Cost: one launch for few words (4096 on GPUs, 2^19 on CPUs), which moves 8 n bytes, else two, which move 12 n bytes.
// The object keeps 4 KiB of device memory.
class Scan {
 public:
  struct State;  // the suite alone knows it
  explicit Scan(const Context& context);
  ~Scan();
  Scan(Scan&&) noexcept;
  Scan& operator=(Scan&&) noexcept;

  // words[i] becomes words[0] + ... + words[i - 1], for i < n; words[0] becomes 0; elements from n on stay. n is at
  // most 2^32 - 1. Throws Error if the buffer is too short or of another context.
  void operator()(const Buffer<uint32_t>& words, size_t n, const Call& call = {});
  // The same, and total[0] becomes the sum of all n words.
  void operator()(const Buffer<uint32_t>& words, size_t n, const Buffer<uint32_t>& total, const Call& call = {});

 private:
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::kernels
