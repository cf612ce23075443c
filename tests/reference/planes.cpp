// SPDX-License-Identifier: Apache-2.0
// The geometry of the brute force: every test looks at all triangles.
// Assumes what planes.hpp says.
#include "reference/planes.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace wavetracer::reference {
namespace {

using glm::dvec3;

constexpr double border_tolerance = 1e-9;    // relative to a triangle's longest side
constexpr double parallel_tolerance = 1e-4;  // sine of the angle between planes that count as one

constexpr double front_m = 5e-4;             // a leg begins this far in front of the surface that it is on
constexpr double position_tolerance = 1e-9;  // relative to coordinates: the error of an interaction's position

bool inside_triangle(const std::array<dvec3, 3>& corner, const dvec3& point) {
  const dvec3 normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
  double size = 0;
  for (int i = 0; i < 3; ++i) size = std::max(size, glm::distance(corner[i], corner[(i + 1) % 3]));
  for (int i = 0; i < 3; ++i) {
    const dvec3 side = corner[(i + 1) % 3] - corner[i];
    const double distance = glm::dot(glm::cross(normal, side), point - corner[i]) / glm::length(side);
    if (distance < -border_tolerance * size) return false;
  }
  return true;
}

// Tells whether the plane of surface i contains the stop.
bool holds(const Scene& scene, const Stop& stop, uint32_t i) {
  const double reach_m = stop.antenna ? plane_distance_m : position_tolerance * (1 + glm::length(stop.point));
  return std::abs(height(scene.surfaces[i], stop.point)) <= reach_m;
}

// 0 means on neither side.
int side_of(const Scene& scene, const Stop& stop, uint32_t i) {
  return holds(scene, stop, i) ? 0 : height(scene.surfaces[i], stop.point) > 0 ? 1 : -1;
}

// Tells whether the stop is on surface i because of its interaction.
bool is_on(const Scene& scene, const Stop& stop, uint32_t i) {
  return std::any_of(stop.on.begin(), stop.on.end(), [&](uint32_t own) {
    const glm::dvec3 &n = scene.surfaces[own].normal, &m = scene.surfaces[i].normal;
    return own == i || (glm::length(glm::cross(n, m)) < 1e-3 &&
                        std::abs(height(scene.surfaces[i], stop.point)) <= plane_distance_m);
  });
}

}  // namespace

double height(const Surface& surface, const dvec3& point) { return glm::dot(surface.normal, point) - surface.offset_m; }

dvec3 mirrored(const Surface& surface, const dvec3& point) {
  return point - 2.0 * height(surface, point) * surface.normal;
}

bool inside_surface(const Scene& scene, uint32_t index, const dvec3& point) {
  const Surface& surface = scene.surfaces[index];
  for (uint32_t i = 0; i < surface.triangle_count; ++i) {
    const auto& corners = scene.triangles[scene.surface_triangles[surface.first_triangle + i]];
    if (inside_triangle({scene.vertices[corners[0]], scene.vertices[corners[1]], scene.vertices[corners[2]]}, point))
      return true;
  }
  return false;
}

std::optional<dvec3> crossing(const Surface& surface, const dvec3& a, const dvec3& b) {
  const double from = height(surface, a), to = height(surface, b);
  if (from * to >= 0) return std::nullopt;
  return a + (b - a) * (from / (from - to));
}

std::vector<Passage> passages(const Scene& scene, const Stop& before, const Stop& a, const Stop& b) {
  const dvec3 from = a.point + front_m * a.front, to = b.point + front_m * b.front;
  const dvec3 beyond = 2 * front_m * glm::normalize(to - from);
  std::vector<Passage> passed;
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    const int side = holds(scene, a, i) && !is_on(scene, a, i) ? side_of(scene, before, i) : side_of(scene, a, i);
    if (is_on(scene, a, i) || is_on(scene, b, i) || side * side_of(scene, b, i) >= 0) continue;
    const auto point = crossing(surface, from - beyond, to + beyond);
    if (!point || !inside_surface(scene, i, *point)) continue;
    const double heights[2] = {height(surface, a.point), height(surface, b.point)};
    const double along = std::clamp(heights[0] / (heights[0] - heights[1]), 0.0, 1.0);
    const dvec3 at = a.point + along * (b.point - a.point);
    const bool known = std::any_of(passed.begin(), passed.end(), [&](const Passage& earlier) {
      const dvec3& normal = scene.surfaces[earlier.surface].normal;
      return glm::distance(earlier.point, at) <= same_vertex_m &&
             glm::length(glm::cross(normal, surface.normal)) <= parallel_tolerance;
    });
    if (!known) passed.push_back({glm::distance(a.point, at), i, at});
  }
  std::sort(passed.begin(), passed.end(),
            [](const Passage& p, const Passage& q) { return p.distance_m < q.distance_m; });
  return passed;
}

std::vector<Passage> passages(const Scene& scene, const dvec3& a, uint32_t a_surface, const dvec3& b,
                              uint32_t b_surface) {
  const auto stop = [](const dvec3& point, uint32_t surface) {
    return Stop{point, true, surface == no_surface ? std::vector<uint32_t>{} : std::vector{surface}, dvec3(0)};
  };
  return passages(scene, stop(a, a_surface), stop(a, a_surface), stop(b, b_surface));
}

}  // namespace wavetracer::reference
