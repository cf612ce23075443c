// What hid solved paths in earlier frames (kernels/lib/blockers.clh): occlusion notes it, solve asks it first. Which
// paths are found does not depend on it; it is worth its memory where frames follow each other.
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
