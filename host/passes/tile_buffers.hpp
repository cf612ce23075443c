// SPDX-License-Identifier: Apache-2.0
// The tiles of a world on the device, for the passes that find paths over them (kernels/lib/tile.clh).
#pragma once
#include <cstdint>

#include "gpu/gpu.hpp"
#include "scene/tiles.hpp"

namespace wavetracer {

struct TileBuffers {
  // Four words per surface: its first tile, the place of that tile's centre, the number of tiles, and its first block,
  // WT_NONE if the surface moves.
  gpu::Buffer<uint32_t> of_surfaces;
  gpu::Buffer<uint32_t> surfaces;  // the surface in the world of each tile
  gpu::Buffer<double> centres;     // three doubles for each tile of the scene and of the models
  gpu::Buffer<double> blocks;      // for each block of WT_TILE_BLOCK tiles the lower and the upper corner of its box
  uint32_t count = 0;              // tiles of the world
};

// surface_count: that of the world.
TileBuffers make_tile_buffers(gpu::Context& context, const TileTable& tiles, uint32_t surface_count);

}  // namespace wavetracer
