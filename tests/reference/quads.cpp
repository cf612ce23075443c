// Fills the arrays of a Scene from parallelograms: two triangles and one surface each.
// Edges are left out: nothing that these scenes serve diffracts.
#include "reference/quads.hpp"
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace wavetracer::reference {

using glm::dvec3;

Scene scene_of_quads(const std::vector<Quad>& quads) {
  Scene scene;
  scene.materials.push_back({.name = "metal", .a = 1, .c = 1e7});
  scene.objects.push_back("quads");
  for (const Quad& quad : quads) {
    const auto first_vertex = static_cast<uint32_t>(scene.vertices.size());
    const auto first_triangle = static_cast<uint32_t>(scene.triangles.size());
    Surface surface;
    surface.normal = glm::normalize(glm::cross(quad.u, quad.v));
    surface.offset_m = glm::dot(surface.normal, quad.corner);
    surface.first_triangle = first_triangle;
    surface.triangle_count = 2;
    surface.lower = surface.upper = quad.corner;
    for (const dvec3& p : {quad.corner, quad.corner + quad.u, quad.corner + quad.u + quad.v, quad.corner + quad.v}) {
      scene.vertices.push_back(p);
      surface.lower = glm::min(surface.lower, p);
      surface.upper = glm::max(surface.upper, p);
    }
    scene.triangles.push_back({first_vertex, first_vertex + 1, first_vertex + 2});
    scene.triangles.push_back({first_vertex, first_vertex + 2, first_vertex + 3});
    for (uint32_t t = first_triangle; t < first_triangle + 2; ++t) {
      scene.triangle_surface.push_back(static_cast<uint32_t>(scene.surfaces.size()));
      scene.triangle_object.push_back(0);
      scene.surface_triangles.push_back(t);
    }
    if (scene.surfaces.empty()) scene.lower = surface.lower, scene.upper = surface.upper;
    scene.lower = glm::min(scene.lower, surface.lower);
    scene.upper = glm::max(scene.upper, surface.upper);
    scene.surfaces.push_back(surface);
  }
  return scene;
}

std::vector<Quad> box_walls(const dvec3& lower, const dvec3& upper) {
  const dvec3 size = upper - lower;
  std::vector<Quad> walls;
  for (int axis = 0; axis < 3; ++axis)
    for (const dvec3& corner : {lower, upper}) {
      dvec3 u(0), v(0), from = lower;
      from[axis] = corner[axis];
      u[(axis + 1) % 3] = size[(axis + 1) % 3];
      v[(axis + 2) % 3] = size[(axis + 2) % 3];
      walls.push_back({from, u, v});
    }
  return walls;
}

}  // namespace wavetracer::reference
