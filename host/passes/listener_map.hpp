// SPDX-License-Identifier: Apache-2.0
// Listeners in squares of the ground plan, for rays that pass them: squares with sides of size_m from (x_m, y_m) on,
// row by row. Coordinates are recentred metres.
#pragma once
#include <cstdint>

#include "gpu/gpu.hpp"

namespace wavetracer {

struct ListenerMap {
  gpu::Buffer<uint32_t> listeners;  // that of each square, WT_NONE where there is none
  gpu::Buffer<float> heights;       // two for each square: the lowest and the highest receiver
  float x_m = 0, y_m = 0, size_m = 1;
  uint32_t columns = 0, rows = 0;
  float low_m = 0, high_m = 0;  // the lowest and the highest of all receivers
};

}  // namespace wavetracer
