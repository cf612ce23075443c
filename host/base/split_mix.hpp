// SPDX-License-Identifier: Apache-2.0
// A stream of random numbers that is the same everywhere: SplitMix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014).
#pragma once
#include <cstdint>

namespace wavetracer {

class SplitMix {
 public:
  explicit SplitMix(uint64_t seed) : state_(seed) {}
  uint64_t next() {
    uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  // Returns a whole number below `end`; the bias of the remainder is below 2^-32.
  uint32_t below(uint32_t end) { return static_cast<uint32_t>(next() % end); }
  // Evenly in (0, 1].
  double uniform() { return (static_cast<double>(next() >> 11) + 1) * 0x1p-53; }

 private:
  uint64_t state_;
};

}  // namespace wavetracer
