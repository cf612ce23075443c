// Solved candidates on the device: what solve produces and occlusion marks.
// Layout: wt_solved in wavetracer/device/records.h.
#pragma once
#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

struct SolvedList {
  gpu::Buffer<wt_solved> headers;
  gpu::Buffer<double> vertices;
  gpu::Buffer<uint32_t> sequences;
  uint32_t count = 0, max_depth = 0;
};

}  // namespace wavetracer
