// SPDX-License-Identifier: Apache-2.0
// Solved, visible paths before fields are computed: the result of the exact geometry. Coordinates are recentred.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace wavetracer {

// Row i: path i from transmitter tx[i] to receiver rx[i]; its interactions are entries first[i] .. first[i + 1].
struct PathGeometry {
  std::vector<uint32_t> tx, rx;
  std::vector<uint8_t> quarters;  // see Paths::quarters; one for every path, or empty
  std::vector<uint64_t> first{0};
  // One per interaction, numbered through the world (Instance::first_surface, first_wedge): the surface of a reflection
  // or transmission, the wedge of a diffraction, the tile of a diffuse scattering (scene/tiles.hpp).
  std::vector<uint32_t> surface;
  std::vector<uint8_t> interaction;  // one per interaction, see Interaction
  std::vector<glm::dvec3> vertex;    // one per interaction, recentred metres
  size_t size() const { return tx.size(); }
};

}  // namespace wavetracer
