// The geometry of the brute force: every question is put to every triangle.
// Assumes what planes.hpp says.
#include "reference/planes.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace wavetracer::reference {
namespace {

using glm::dvec3;

constexpr double border_tolerance = 1e-9;    // of a triangle's longest side
constexpr double parallel_tolerance = 1e-4;  // sine of the angle between planes that count as one

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

std::vector<Passage> passages(const Scene& scene, const dvec3& a, uint32_t a_surface, const dvec3& b,
                              uint32_t b_surface) {
  std::vector<Passage> passed;
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (i == a_surface || i == b_surface) continue;
    if (std::abs(height(surface, a)) <= plane_distance_m || std::abs(height(surface, b)) <= plane_distance_m) continue;
    const auto point = crossing(surface, a, b);
    if (!point || !inside_surface(scene, i, *point)) continue;
    const bool known = std::any_of(passed.begin(), passed.end(), [&](const Passage& earlier) {
      const dvec3& normal = scene.surfaces[earlier.surface].normal;
      return glm::distance(earlier.point, *point) <= same_vertex_m &&
             glm::length(glm::cross(normal, surface.normal)) <= parallel_tolerance;
    });
    if (!known) passed.push_back({glm::distance(a, *point), i, *point});
  }
  std::sort(passed.begin(), passed.end(),
            [](const Passage& p, const Passage& q) { return p.distance_m < q.distance_m; });
  return passed;
}

}  // namespace wavetracer::reference
