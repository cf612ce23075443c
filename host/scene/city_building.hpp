// SPDX-License-Identifier: Apache-2.0
// Buildings that the city generator places: closed solids on an integer grid of 1/8 m.
// Coordinates must be below 2^20 grid units (131 km), so that float32 holds them exactly.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/raw_scene.hpp"

namespace wavetracer::city {

constexpr int grid_per_m = 8;

// The place of a footprint: point (a, b) lies at corner + a * u + b * v in grid units. u and v are perpendicular and
// equally long: (1, 0), (0, 1) is axis-parallel; (4, 3), (-3, 4) is turned by 36.87 degrees and still on the grid.
struct Frame {
  std::array<int, 2> corner{0, 0};
  std::array<int, 2> u{1, 0}, v{0, 1};
};

// The cells of a footprint: cell (i, j) spans a[i] .. a[i + 1] and b[j] .. b[j + 1]; occupied(i, j) is bit j * 3 + i.
// Occupied cells must not touch at corners only (the solid would not be a manifold).
struct Footprint {
  Frame frame;
  std::array<int, 4> a, b;
  uint32_t cells = 0;
};

constexpr uint32_t full_cells = 0b111111111, ring_cells = 0b111101111, l_cells = 0b001001111, u_cells = 0b111001111,
                   t_cells = 0b010010111;

struct BuildingMeshes {
  RawMesh walls;  // includes the floor below the ground
  RawMesh roof;
};

// Makes a building with a flat roof at this height. Walls, roof and floor are split along the cells, so no corner lies
// inside an edge.
BuildingMeshes flat_building(const Footprint& footprint, int foundation, int height);

// Makes a building with a gabled roof over the rectangle a[0] .. a[3] by b[0] .. b[3]; the ridge runs along the longer
// side, `rise` above the eaves. The shorter side must be even.
BuildingMeshes gabled_building(const Footprint& footprint, int foundation, int eaves, int rise);

}  // namespace wavetracer::city
