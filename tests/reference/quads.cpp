// SPDX-License-Identifier: Apache-2.0
// Fills the arrays of a Scene from parallelograms: two triangles and one surface each.
// Edges are left out, and wedges are those that the test asks for.
#include "reference/quads.hpp"
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

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

std::vector<Wedge> box_wedges(const dvec3& lower, const dvec3& upper, uint32_t first_surface) {
  std::vector<Wedge> wedges;
  const auto outward = [](int axis, uint32_t side) {
    dvec3 normal(0);
    normal[axis] = side == 0 ? -1 : 1;
    return normal;
  };
  for (int axis = 0; axis < 3; ++axis) {  // wall 0 is normal to this axis, wall 1 to the next, the edge to both
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    for (uint32_t side = 0; side < 4; ++side) {
      const uint32_t low = side % 2, high = side / 2;
      Wedge wedge;
      wedge.face = -outward(next, high);
      wedge.normal = outward(axis, low);
      wedge.along = glm::cross(wedge.face, wedge.normal);
      wedge.length_m = upper[last] - lower[last];
      wedge.start[axis] = low == 0 ? lower[axis] : upper[axis];
      wedge.start[next] = high == 0 ? lower[next] : upper[next];
      wedge.start[last] = wedge.along[last] > 0 ? lower[last] : upper[last];
      wedge.exterior_rad = 1.5 * std::numbers::pi;
      wedge.surface = {first_surface + 2 * static_cast<uint32_t>(axis) + low,
                       first_surface + 2 * static_cast<uint32_t>(next) + high};
      wedge.plane = wedge.surface;
      wedges.push_back(wedge);
    }
  }
  return wedges;
}

std::vector<Wedge> free_wedges(const Quad& quad, uint32_t surface) {
  const dvec3 corners[] = {quad.corner, quad.corner + quad.u, quad.corner + quad.u + quad.v, quad.corner + quad.v};
  std::vector<Wedge> wedges;
  for (size_t i = 0; i < 4; ++i) {
    const dvec3 side = corners[(i + 1) % 4] - corners[i];
    Wedge wedge;
    wedge.start = corners[i];
    wedge.length_m = glm::length(side);
    wedge.along = side / wedge.length_m;
    wedge.normal = glm::normalize(glm::cross(quad.u, quad.v));
    wedge.face = glm::cross(wedge.normal, wedge.along);
    wedge.exterior_rad = 2 * std::numbers::pi;
    wedge.surface = wedge.plane = {surface, surface};
    wedges.push_back(wedge);
  }
  return wedges;
}

}  // namespace wavetracer::reference
