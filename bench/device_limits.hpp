// SPDX-License-Identifier: Apache-2.0
// Measures the limits of a device: no kernel is faster than its bytes, random accesses, operations and
// launches allow. The machine must
// be quiet.
#pragma once
#include <cstddef>

#include "gpu/gpu.hpp"

namespace wavetracer::bench {

struct DeviceLimits {
  double bytes_s = 0;                   // read and written by a copy that no cache holds
  double slots_s = 0, words_s = 0;      // places at random, of 64 and of 8 bytes: 256 MiB on CPUs, else 1 GiB
  double singles_s = 0, doubles_s = 0;  // operations of float and double; a fused multiply and add counts as two
  double launch_s = 0;                  // the shortest time of a nearly empty kernel, by the device's clock
};

// Returns medians of `runs` runs each.
DeviceLimits measure_limits(gpu::Context& context, size_t runs);

}  // namespace wavetracer::bench
