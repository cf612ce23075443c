// SPDX-License-Identifier: Apache-2.0
// Cells of vegetation that scatters: its volumes are cut along their axes into boxes whose sides are at most as long as
// trace.tile_m, and boxes whose centre is inside are cells. They share the volume evenly, so all of it counts even if
// they are few. A centre that is also in an earlier volume is no cell of this one. Cells of the world are numbered
// after its tiles (scene/tiles.hpp).
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

struct Cell {
  glm::dvec3 centre_m;
  double volume_m3;
  uint32_t volume;  // number in Scene::volumes
};

// Does the material of any volume scatter (Material::scattering > 0)?
bool has_cells(const Scene& scene);
// Makes the cells of those volumes, in their order. most: the number of cells that are possible. Throws ConfigError,
// naming trace.tile_m, for more.
std::vector<Cell> make_cells(const Scene& scene, double cell_m, uint64_t most);

}  // namespace wavetracer
