// SPDX-License-Identifier: Apache-2.0
// Instances of one model share the centres of its tiles.
#include "passes/tile_buffers.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <vector>

#include "passes/advice.hpp"
#include "wavetracer/device/points.h"

namespace wavetracer {
namespace {

// Appends the boxes of the blocks of tiles that are on one surface.
void add_blocks(std::span<const Tile> tiles, std::vector<double>& blocks) {
  for (size_t first = 0; first < tiles.size(); first += WT_TILE_BLOCK) {
    glm::dvec3 low = tiles[first].centre_m, high = low;
    for (const Tile& tile : tiles.subspan(first, std::min<size_t>(WT_TILE_BLOCK, tiles.size() - first))) {
      low = glm::min(low, tile.centre_m);
      high = glm::max(high, tile.centre_m);
    }
    blocks.insert(blocks.end(), {low.x, low.y, low.z, high.x, high.y, high.z});
  }
}

}  // namespace

TileBuffers make_tile_buffers(gpu::Context& context, const TileTable& tiles, uint32_t surface_count) {
  std::vector<double> centres;
  std::vector<uint32_t> first_centre;  // first centre of each part
  for (uint32_t part = 0; part < tiles.part_count(); ++part) {
    first_centre.push_back(static_cast<uint32_t>(centres.size() / 3));
    for (const Tile& tile : tiles.tiles(part))
      centres.insert(centres.end(), {tile.centre_m.x, tile.centre_m.y, tile.centre_m.z});
  }
  std::vector<uint32_t> of_surfaces(4 * size_t{surface_count}, 0), surfaces(tiles.size());
  std::vector<double> blocks;
  for (size_t surface = 0; surface < surface_count; ++surface) of_surfaces[4 * surface + 3] = WT_NONE;
  const auto enter = [&](uint32_t part, uint32_t first_surface, uint32_t first_tile) {
    for (uint32_t k = 0; k < tiles.tiles(part).size(); ++k) {
      const uint32_t surface = surfaces[first_tile + k] = first_surface + tiles.tiles(part)[k].surface;
      uint32_t* entry = &of_surfaces[4 * size_t{surface}];
      if (entry[2]++ > 0) continue;  // tiles of a surface follow each other
      entry[0] = first_tile + k;
      entry[1] = first_centre[part] + k;
    }
  };
  enter(0, 0, 0);
  for (size_t surface = 0; surface < surface_count; ++surface) {
    uint32_t* entry = &of_surfaces[4 * surface];
    if (entry[2] == 0) continue;
    entry[3] = static_cast<uint32_t>(blocks.size() / 6);
    add_blocks(std::span(tiles.tiles(0)).subspan(entry[0], entry[2]), blocks);
  }
  for (uint32_t i = 0; i < tiles.instances().size(); ++i)
    enter(1 + tiles.instances()[i].model, tiles.instances()[i].first_surface, tiles.first_tile(i));
  return {.of_surfaces = context.buffer(of_surfaces, {"tiles of surfaces", advice::tiles}),
          .surfaces = context.buffer(surfaces, {"surfaces of tiles", advice::tiles}),
          .centres = context.buffer(centres, {"tiles", advice::tiles}),
          .blocks = context.buffer(blocks, {"blocks of tiles", advice::tiles}),
          .count = tiles.size()};
}

}  // namespace wavetracer
