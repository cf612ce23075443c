// SPDX-License-Identifier: Apache-2.0
// Polygons in space on the grid of imports/rings.hpp, and their triangles, found in the axis-parallel plane that is
// closest to theirs. Coordinates must be below 10^9 m; larger ones are reported as a fault.
#pragma once
#include <compare>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

#include "imports/city_model.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer::imports {

struct GridCorner {
  int64_t x = 0, y = 0, z = 0;
  auto operator<=>(const GridCorner&) const = default;
};

struct GridFace {
  Role role = Role::unknown;
  std::vector<std::vector<GridCorner>> rings;  // the outer one first
};

GridFace on_grid(const ModelFace& face);
glm::dvec3 metres(const GridCorner& corner);

// Returns half of the sum of cross products around the outer ring: the area times the normal, counter-clockwise, in m2.
glm::dvec3 area_vector(const GridFace& face);
// Returns six times the volume of the cone from a point to the outer ring, in m3; summed over all faces of a solid that
// look outward, it is six times the solid's volume.
double cone_m3(const GridFace& face, const GridCorner& from);

// Removes superfluous corners and holes: corners that repeat the one before, spikes, empty holes.
void tidy(GridFace& face);

struct FaceTriangles {
  std::vector<Triangle> triangles;  // indices of the corners of all rings in their order, oriented as the outer ring
  std::string_view fault;           // the reason if there are no triangles
  bool crossing = false;            // the outline crosses or touches itself, but has triangles
  double bend_m = 0;                // largest distance of a corner from the plane
};
FaceTriangles triangulate_face(const GridFace& face);

}  // namespace wavetracer::imports
