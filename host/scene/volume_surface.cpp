// SPDX-License-Identifier: Apache-2.0
// A shape that is no mesh is made of rings about the z axis of the unit cube, square or round, from bottom to top. A
// ring of radius zero is a pole, whose triangles without area are left out.
#include "scene/volume_surface.hpp"

#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>

namespace wavetracer {
namespace {

using glm::dvec3;
using Corners = std::array<dvec3, 3>;

struct Ring {
  double radius, z;
};

constexpr int round_sides = 16, spheroid_rows = 8;

std::vector<Ring> rings_of(VolumeShape shape) {
  if (shape != VolumeShape::spheroid) return {{0, -1}, {1, -1}, {1, 1}, {0, 1}};
  std::vector<Ring> out{{0, -1}};
  for (int row = 1; row < spheroid_rows; ++row) {
    const double angle = std::numbers::pi * row / spheroid_rows;
    out.push_back({std::sin(angle), -std::cos(angle)});
  }
  out.push_back({0, 1});
  return out;
}

// Returns the corners of a ring about z, counter-clockwise seen from above.
std::vector<glm::dvec2> circle_of(VolumeShape shape) {
  if (shape == VolumeShape::box) return {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<glm::dvec2> out;
  for (int side = 0; side < round_sides; ++side) {
    const double angle = 2 * std::numbers::pi * side / round_sides;
    out.emplace_back(std::cos(angle), std::sin(angle));
  }
  return out;
}

}  // namespace

std::vector<Corners> surface_triangles(const Volume& volume) {
  if (volume.shape == VolumeShape::mesh) return volume.triangles;
  const std::vector<Ring> rings = rings_of(volume.shape);
  const std::vector<glm::dvec2> circle = circle_of(volume.shape);
  const double c = std::cos(volume.yaw_rad), s = std::sin(volume.yaw_rad);
  const auto corner = [&](const Ring& ring, size_t side) {
    const glm::dvec2 at = ring.radius * circle[side % circle.size()];
    const dvec3 p = dvec3(at, ring.z) * volume.half_size;
    return volume.centre + dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
  };
  std::vector<Corners> out;
  for (size_t row = 0; row + 1 < rings.size(); ++row)
    for (size_t side = 0; side < circle.size(); ++side) {
      const dvec3 below = corner(rings[row], side), below_next = corner(rings[row], side + 1);
      const dvec3 above = corner(rings[row + 1], side), above_next = corner(rings[row + 1], side + 1);
      if (rings[row].radius > 0) out.push_back({below, below_next, above_next});
      if (rings[row + 1].radius > 0) out.push_back({below, above_next, above});
    }
  return out;
}

}  // namespace wavetracer
