// SPDX-License-Identifier: Apache-2.0
// Functions that the kernel benchmarks share: medians, wall time, and the bandwidth of the device's own copy. The
// machine must be quiet.
#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "gpu/gpu.hpp"

namespace wavetracer::bench {

inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

template <class Body>
double wall_seconds(const Body& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Returns the time of all device work since the last reset of the profile, by the device's clock.
inline double device_seconds(gpu::Context& context) {
  double total = 0;
  for (const auto& [stage, seconds] : context.profile()) total += seconds;
  return total;
}

// Returns bytes read and written per second, by a copy that no cache holds: 256 MiB on CPUs, 2 GiB on other devices.
inline double copy_bandwidth(gpu::Context& context, size_t runs) {
  const uint64_t wanted = context.info().cpu ? uint64_t{256} << 20 : uint64_t{2} << 30;
  const size_t words = std::min(wanted, context.info().max_buffer / 4) / sizeof(uint32_t);
  auto from = context.buffer<uint32_t>(words, "copied"), to = context.buffer<uint32_t>(words, "copy");
  context.fill(from, 1u);
  context.copy(from, to, from.bytes());
  std::vector<double> seconds;
  for (size_t run = 0; run < runs; run++) {
    context.finish();
    context.reset_profile();
    context.copy(from, to, from.bytes());
    seconds.push_back(device_seconds(context));
  }
  return 2 * static_cast<double>(from.bytes()) / median(seconds);
}

}  // namespace wavetracer::bench
