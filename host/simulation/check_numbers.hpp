// SPDX-License-Identifier: Apache-2.0
// Numbers for checks: the same on every machine and in every run.
#pragma once
#include <cstdint>

namespace wavetracer {

class CheckNumbers {
 public:
  explicit CheckNumbers(uint64_t seed) : state_(seed) {}
  // These are D. Knuth's constants for modulo 2^64; the high bits are the good ones.
  uint32_t operator()() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<uint32_t>(state_ >> 32);
  }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(uint64_t{(*this)()} * count >> 32); }
  double between(double low, double high) { return low + (high - low) * ((*this)() * 0x1p-32); }

 private:
  uint64_t state_;
};

}  // namespace wavetracer
