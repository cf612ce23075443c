// SPDX-License-Identifier: Apache-2.0
// The shape of a launch: one, two or three dimensions, row by row or along Hilbert curves (kernels/lib/launch.clh). It
// serves the thesis' experiment of section 3.1; results do not depend on it.
#pragma once
#include <cstdint>
#include <optional>

#include "gpu/gpu.hpp"

namespace wavetracer {

struct LaunchShape {
  unsigned dimensions = 1;
  bool curve = false;                       // 2D and 3D: squares or cubes walked along a Hilbert curve instead of rows
  std::optional<uint32_t> local_size = {};  // work-items per group, a power of two; not set: the pass chooses

  bool plain() const { return dimensions == 1 && !local_size; }
  // A range of at least `count` work-items whose indices by wt_launch_index cover 0 .. count - 1.
  gpu::Range range(size_t count, uint32_t preferred_local) const;
  // Adds the definitions that wt_launch_index is built with.
  void define(gpu::Definitions& definitions) const;
};

}  // namespace wavetracer
