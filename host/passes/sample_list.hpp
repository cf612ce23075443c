// SPDX-License-Identifier: Apache-2.0
// The samples of one level of a refined launch: each is a cell of the sphere of directions and a launcher. They are in
// the order of the launchers, then along the curve of the cells. The list also says where each sample ended.
#pragma once
#include <cstdint>

#include "gpu/gpu.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

// Cells of level 0 of the hilbert map (wavetracer/device/directions.h); each level has four times as many, which the
// map lays out as twelve faces from level 1 on.
constexpr uint32_t sample_faces = 3;
constexpr uint32_t finest_level = 12;  // 50 million cells

struct SampleList {
  gpu::Buffer<uint32_t> samples;  // a plane of cells, then a plane of launchers
  gpu::Buffer<uint32_t> ends;     // nodes of the set of sequences, roots where the ray hit nothing
  uint32_t capacity = 0, count = 0, level = 0;
  uint64_t cells() const { return uint64_t{sample_faces} << (2 * level); }
};

inline SampleList make_sample_list(gpu::Context& context, uint64_t count) {
  if (count > 0xFFFFFE00u)
    throw RuntimeError("a launch of rays = \"auto\" has outgrown 2^32 rays in a level; lower trace.max_rays");
  // Kernels read 16 samples at once.
  const auto capacity = static_cast<uint32_t>((count + 255) / 256 * 256 + 256);
  return {context.buffer<uint32_t>(2 * size_t{capacity}, "samples"), context.buffer<uint32_t>(capacity, "ends"),
          capacity};
}

}  // namespace wavetracer
