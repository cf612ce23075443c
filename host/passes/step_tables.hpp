// SPDX-License-Identifier: Apache-2.0
// Tables of the wedges and tiles that steps of solved paths name, for the passes that check legs (kernels/lib/leg.clh).
#pragma once
#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

// A pointer is null where paths have no such steps.
struct StepTables {
  const gpu::Buffer<wt_wedge>* wedges = nullptr;           // wedges of the world, as they are placed
  const gpu::Buffer<uint32_t>* surface_of_tile = nullptr;  // surface of each tile; cells of vegetation follow
  const gpu::Buffer<wt_target_point>* targets = nullptr;   // points of targets, as they are placed

  uint32_t tile_count() const { return surface_of_tile ? static_cast<uint32_t>(surface_of_tile->size()) : 0; }
};

}  // namespace wavetracer
