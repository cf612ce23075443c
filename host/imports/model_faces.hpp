// Polygons in space on the grid of imports/rings.hpp, and their triangles, found in the plane that they lie in most.
// Assumes coordinates below 10^9 m; what is out of bounds is a fault.
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

// Half of the sum of cross products round the outer ring: its area along its normal, counter-clockwise, in m2.
glm::dvec3 area_vector(const GridFace& face);
// Six times the volume under the outer ring, as seen from a point, in m3; over all faces of a solid that look outward
// the sum is six times its volume.
double cone_m3(const GridFace& face, const GridCorner& from);

// Removes what a face does not need: corners that repeat the one before, ways there and back, holes of nothing.
void tidy(GridFace& face);

struct FaceTriangles {
  std::vector<Triangle> triangles;  // over the corners of all rings in their order, turning as the outer ring does
  std::string_view fault;           // why there are none
  bool crossing = false;            // the outline crosses or touches itself, and has triangles all the same
  double bend_m = 0;                // how far corners are from their plane
};
FaceTriangles triangulate_face(const GridFace& face);

}  // namespace wavetracer::imports
