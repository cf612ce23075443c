// Solved candidates on the device: what solve produces, occlusion marks and visible selects.
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

  // Room for so many rows of max_depth; what was there is lost.
  void reserve(gpu::Context& context, size_t rows) {
    headers = context.buffer<wt_solved>(rows, "solved paths");
    vertices = context.buffer<double>(3 * rows * max_depth, "path vertices");
    sequences = context.buffer<uint32_t>(rows * max_depth, "path surfaces");
  }
};

}  // namespace wavetracer
