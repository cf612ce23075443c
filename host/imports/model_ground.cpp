// SPDX-License-Identifier: Apache-2.0
// Roles follow from slopes, feet from ground surfaces.
// The outer ring of a face must have corners.
#include "imports/model_ground.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <map>

#include "imports/rings.hpp"
#include "imports/terrain.hpp"

namespace wavetracer::imports {
namespace {

// A surface without a role is a wall if the cosine of its normal to the vertical is below this.
constexpr double steepest_roof = 0.1;

}  // namespace

void tell_roles(Body& body) {
  const GridCorner from = body.faces[0].rings[0][0];
  double sum = 0, all = 0;
  for (const GridFace& face : body.faces) {
    const double cone = cone_m3(face, from);
    sum += cone;
    all += std::abs(cone);
  }
  body.inward = sum < -0.05 * all;
  for (GridFace& face : body.faces) {
    if (face.role != Role::unknown) continue;
    const glm::dvec3 area = area_vector(face) * (body.inward ? -1.0 : 1.0);
    const double up = area.z / std::max(glm::length(area), 1e-12);
    face.role = up > steepest_roof ? Role::roof : up < -steepest_roof ? Role::ground : Role::wall;
  }
}

int64_t lowest_corner(const Family& family) {
  int64_t lowest = std::numeric_limits<int64_t>::max();
  for (const Body& body : family)
    for (const GridFace& face : body.faces)
      for (const auto& ring : face.rings)
        for (const GridCorner& p : ring) lowest = std::min(lowest, p.z);
  return lowest;
}

std::set<GridCorner> feet_of(const Family& family, int64_t lowest, double storey_m) {
  const auto limit = lowest + std::llround(storey_m * grid_per_m);
  std::set<GridCorner> out;
  std::map<std::pair<int64_t, int64_t>, int64_t> lowest_at;
  bool any_ground = false;
  for (const Body& body : family)
    for (const GridFace& face : body.faces) {
      any_ground = any_ground || face.role == Role::ground;
      if (face.role == Role::ground)
        for (const auto& ring : face.rings)
          std::ranges::copy_if(ring, std::inserter(out, out.end()), [&](const GridCorner& p) { return p.z < limit; });
      if (face.role == Role::wall)
        for (const GridCorner& p : face.rings[0]) {
          const auto entry = lowest_at.try_emplace({p.x, p.y}, p.z).first;
          entry->second = std::min(entry->second, p.z);
        }
    }
  if (!any_ground)
    for (const auto& [place, z] : lowest_at)
      if (z < limit) out.insert({place.first, place.second, z});
  return out;
}

std::optional<double> terrain_below(const Ground& ground, const Family& family) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Body& body : family)
    for (const GridFace& face : body.faces) {
      if (face.role != Role::ground && face.role != Role::roof) continue;
      std::vector<glm::dvec2> ring;
      for (const GridCorner& p : face.rings[0]) ring.emplace_back(metres(p));
      const std::optional<double> z = lowest_along(ground, ring);
      if (!z) return {};
      lowest = std::min(lowest, *z);
    }
  return lowest;
}

void move(Family& family, const std::set<GridCorner>& feet, int64_t foot, int64_t rise) {
  for (Body& body : family) {
    std::erase_if(body.faces, [&](const GridFace& face) {
      return face.role == Role::wall &&
             std::ranges::all_of(face.rings[0], [&](const GridCorner& p) { return feet.contains(p); });
    });
    for (GridFace& face : body.faces)
      for (auto& ring : face.rings)
        for (GridCorner& p : ring) p.z = feet.contains(p) ? foot : p.z + rise;
  }
}

}  // namespace wavetracer::imports
