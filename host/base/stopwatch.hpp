// SPDX-License-Identifier: Apache-2.0
// Measures wall time of host stages.
// It uses a steady clock; times of device stages come from profiling events instead.
#pragma once
#include <chrono>

namespace wavetracer {

class Stopwatch {
 public:
  // Returns the seconds since construction or the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace wavetracer
