// SPDX-License-Identifier: Apache-2.0
// The triangles that hid solved paths in earlier frames (kernels/lib/blockers.clh): occlusion stores them, solve tests
// them first. They do not change which paths are found; they are worth their memory where frames follow each other.
#pragma once
#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

struct Blockers {
  static constexpr uint32_t entries = 1 << 21;  // a power of two; paths that share one overwrite each other
  static constexpr uint32_t mask = entries - 1;

  explicit Blockers(gpu::Context& context) : places(context.buffer<uint32_t>(entries, "what hid paths")) {
    context.fill(places, WT_NONE);
  }
  gpu::Buffer<uint32_t> places;
};

}  // namespace wavetracer
