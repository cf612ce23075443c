// SPDX-License-Identifier: Apache-2.0
#include "bodies/body.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "bodies/polygons.hpp"
#include "radio/material.hpp"
#include "scene/closed_mesh.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using Corner = std::array<double, 3>;
Corner corner_of(glm::dvec3 p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }  // no -0

BodyMaterial body_material(const Material& material, double frequency_hz) {
  BodyMaterial layers;
  for (const Material& layer : material.layers)
    layers.push_back({complex_permittivity(layer, frequency_hz), layer.thickness_m});
  if (layers.empty()) layers.push_back({complex_permittivity(material, frequency_hz), material.thickness_m});
  return layers;
}

// The text of what is wrong with a facet, or nothing.
std::string facet_problem(const Facet& facet, size_t materials) {
  const Polygon& corners = facet.corners;
  if (corners.size() < 3) return "has fewer than three corners; give it three or more";
  for (const glm::dvec3 p : corners)
    if (!std::isfinite(p.x + p.y + p.z)) return "has a corner that is no finite number; mend the file that it is from";
  if (facet.material >= materials)
    return fmt::format("has the material {}, but there are {}; give it one of these", facet.material, materials);
  double size = 0;
  for (const glm::dvec3 p : corners) size = std::max(size, glm::length(p - corners[0]));
  const glm::dvec3 area = area_vector(corners);
  if (!(glm::length(area) > 1e-12 * size * size)) return "has no area; leave it out";
  const Plane plane = plane_of(corners);
  for (size_t i = 0; i < corners.size(); ++i) {
    if (std::abs(height_over(plane, corners[i])) > 1e-6 * size) return "is not flat; cut it into triangles";
    const glm::dvec3 next = corners[(i + 1) % corners.size()], after = corners[(i + 2) % corners.size()];
    if (glm::dot(glm::cross(next - corners[i], after - next), plane.normal) < -1e-9 * size * size)
      return "is not convex; cut it into triangles";
  }
  return {};
}

}  // namespace

bool is_closed(const Body& body) {
  DirectedEdges<Corner> edges;
  double volume = 0;
  for (const Facet& facet : body.facets) {
    volume += glm::dot(area_vector(facet.corners), facet.corners[0]);
    for (size_t i = 0; i < facet.corners.size(); ++i)
      ++edges[{corner_of(facet.corners[i]), corner_of(facet.corners[(i + 1) % facet.corners.size()])}];
  }
  return edges_pair_up(edges) && volume > 0;
}

void check_body(const Body& body) {
  if (body.facets.empty())
    throw InputError("this body has no facets: physical optics needs at least one; check the file of its mesh");
  for (size_t i = 0; i < body.facets.size(); ++i) {
    const std::string problem = facet_problem(body.facets[i], body.materials.size());
    if (!problem.empty()) throw InputError(fmt::format("facet {} of a body of {} {}", i, body.facets.size(), problem));
  }
}

Body body_of(const Scene& scene, double frequency_hz) {
  Body body;
  for (const Material& material : scene.materials)
    body.materials.push_back(material.vegetation ? BodyMaterial{} : body_material(material, frequency_hz));
  for (size_t i = 0; i < scene.triangles.size(); ++i) {
    Facet facet;
    for (const uint32_t vertex : scene.triangles[i]) facet.corners.push_back(scene.vertices[vertex] + scene.origin_m);
    facet.material = scene.surfaces[scene.triangle_surface[i]].material;
    body.facets.push_back(std::move(facet));
  }
  return body;
}

}  // namespace wavetracer
