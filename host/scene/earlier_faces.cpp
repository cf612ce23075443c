// Candidates come from a grid over the triangles. Two triangles of one plane overlap where no side of either parts
// them.
#include "scene/earlier_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/triangle_grid.hpp"
#include "scene/weld.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
using Face = std::array<dvec3, 3>;

constexpr double in_plane_m = 1e-4;  // as coplanar surfaces are joined

Face face_of(const Scene& scene, uint32_t t) {
  const auto& [a, b, c] = scene.triangles[t];
  return {scene.vertices[a], scene.vertices[b], scene.vertices[c]};
}

dvec3 normal_of(const Face& f) { return glm::normalize(glm::cross(f[1] - f[0], f[2] - f[0])); }

bool in_one_plane(const Face& a, const dvec3& normal, const Face& b) {
  return std::ranges::all_of(b, [&](const dvec3& p) { return std::abs(glm::dot(p - a[0], normal)) <= in_plane_m; });
}

// Inwards from a side, in the plane.
dvec3 inwards(const Face& f, size_t side, const dvec3& normal) {
  return glm::normalize(glm::cross(normal, f[(side + 1) % 3] - f[side]));
}

// Does a side of f have all of the other triangle outside of it, but for what welding moves?
bool parted_by_a_side(const Face& f, const dvec3& normal, const Face& other) {
  for (size_t side = 0; side < 3; ++side) {
    const dvec3 in = inwards(f, side, normal);
    if (std::ranges::all_of(other, [&](const dvec3& p) { return glm::dot(p - f[side], in) <= weld_tolerance_m; }))
      return true;
  }
  return false;
}

bool overlap(const Face& a, const dvec3& normal, const Face& b) {
  return in_one_plane(a, normal, b) && !parted_by_a_side(a, normal, b) && !parted_by_a_side(b, normal_of(b), a);
}

std::vector<bool> scattering_triangles(const Scene& scene) {
  std::vector<bool> out(scene.triangles.size());
  for (const Surface& surface : scene.surfaces)
    for (uint32_t k = 0; k < surface.triangle_count; ++k)
      out[scene.surface_triangles[surface.first_triangle + k]] = scene.materials[surface.material].scattering > 0;
  return out;
}

}  // namespace

EarlierFaces::EarlierFaces(const Scene& scene) : scene_(scene), below_(scene.triangles.size()) {
  const std::vector<bool> scatters = scattering_triangles(scene);
  if (std::ranges::none_of(scatters, [](bool one) { return one; })) return;
  const TriangleGrid grid(scene);
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (!scatters[t]) continue;
    std::vector<uint32_t>& below = below_[t];
    const Face face = face_of(scene, t);
    const dvec3 normal = normal_of(face);
    grid.grid().visit_box(grid.boxes()[t], [&](uint32_t cell) {
      for (const uint32_t other : grid[cell])
        if (other < t && scatters[other] && std::ranges::find(below, other) == below.end() &&
            overlap(face, normal, face_of(scene, other)))
          below.push_back(other);
    });
  }
}

bool EarlierFaces::hold(uint32_t triangle, const dvec3& point) const {
  constexpr double rounding_m = 1e-9;
  return std::ranges::any_of(below_[triangle], [&](uint32_t other) {
    const Face f = face_of(scene_, other);
    const dvec3 normal = normal_of(f);
    for (size_t side = 0; side < 3; ++side)
      if (glm::dot(point - f[side], inwards(f, side, normal)) < -rounding_m) return false;
    return true;
  });
}

uint64_t EarlierFaces::count() const {
  return static_cast<uint64_t>(std::ranges::count_if(below_, [](const auto& list) { return !list.empty(); }));
}

}  // namespace wavetracer
