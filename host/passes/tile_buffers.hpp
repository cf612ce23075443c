// SPDX-License-Identifier: Apache-2.0
// The tiles of a world on the device, for the passes that find paths over them (kernels/lib/tile.clh).
#pragma once
#include <cstdint>

#include "gpu/gpu.hpp"
#include "scene/tiles.hpp"

namespace wavetracer {

struct TileBuffers {
  gpu::Buffer<uint32_t> of_surfaces;  // four words per surface: its first tile, the place of its centre, the number
  gpu::Buffer<uint32_t> surfaces;     // the surface in the world of each tile
  gpu::Buffer<double> centres;        // three doubles for each tile of the scene and of the models
  uint32_t count = 0;                 // tiles of the world
};

// surface_count: that of the world.
TileBuffers make_tile_buffers(gpu::Context& context, const TileTable& tiles, uint32_t surface_count);

}  // namespace wavetracer
