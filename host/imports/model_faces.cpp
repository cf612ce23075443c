// SPDX-License-Identifier: Apache-2.0
// Polygons are triangulated in a plane of two axes, so that corners stay on the grid and the triangulator's tests stay
// exact. Normals are computed by M. Newell's sum (Sutherland, Sproull and Schumacker, 1974), which any polygon has,
// flat or not.
#include "imports/model_faces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "imports/rings.hpp"
#include "imports/triangulate.hpp"

namespace wavetracer::imports {
namespace {

glm::dvec3 difference(const GridCorner& a, const GridCorner& b) {
  return glm::dvec3(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y), static_cast<double>(a.z - b.z)) /
         static_cast<double>(grid_per_m);
}

// Drops the axis that the face's normal is closest to, in a way that keeps the face's orientation.
Point flattened(const GridCorner& p, int axis) {
  if (axis == 0) return {p.y, p.z};
  if (axis == 1) return {p.z, p.x};
  return {p.x, p.y};
}

double bend(const GridFace& face, const glm::dvec3& normal) {
  double most = 0;
  glm::dvec3 middle(0);
  const std::vector<GridCorner>& outer = face.rings[0];
  for (const GridCorner& p : outer) middle += difference(p, outer[0]) / static_cast<double>(outer.size());
  for (const auto& ring : face.rings)
    for (const GridCorner& p : ring)
      most = std::max(most, std::abs(glm::dot(difference(p, outer[0]) - middle, normal)));
  return most;
}

}  // namespace

glm::dvec3 metres(const GridCorner& p) { return difference(p, {}); }

GridFace on_grid(const ModelFace& face) {
  GridFace out{face.role, {}};
  for (const SpaceRing& ring : face.rings) {
    auto& to = out.rings.emplace_back();
    for (const glm::dvec3& p : ring)
      to.push_back({std::llround(p.x * grid_per_m), std::llround(p.y * grid_per_m), std::llround(p.z * grid_per_m)});
  }
  tidy(out);
  return out;
}

void tidy(GridFace& face) {
  for (auto& ring : face.rings) {
    std::vector<GridCorner> out;
    for (const GridCorner& p : ring) {
      if (!out.empty() && out.back() == p) continue;
      if (out.size() > 1 && out[out.size() - 2] == p)
        out.pop_back();
      else
        out.push_back(p);
    }
    // Does the same where the ring closes.
    size_t first = 0;
    while (out.size() - first > 1) {
      if (out[first] == out.back()) {
        out.pop_back();
      } else if (out.size() - first > 2 && out[first + 1] == out.back()) {
        ++first;
      } else if (out.size() - first > 2 && out[out.size() - 2] == out[first]) {
        out.pop_back();
      } else {
        break;
      }
    }
    ring.assign(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
  }
  // Removes holes that have become empty.
  if (face.rings.size() > 1)
    face.rings.erase(
        std::remove_if(face.rings.begin() + 1, face.rings.end(), [](const auto& ring) { return ring.size() < 3; }),
        face.rings.end());
}

glm::dvec3 area_vector(const GridFace& face) {
  glm::dvec3 sum(0);
  if (face.rings.empty()) return sum;
  const std::vector<GridCorner>& ring = face.rings[0];
  for (size_t i = 1; i + 1 < ring.size(); ++i)
    sum += glm::cross(difference(ring[i], ring[0]), difference(ring[i + 1], ring[0]));
  return sum / 2.0;
}

double cone_m3(const GridFace& face, const GridCorner& from) {
  if (face.rings.empty() || face.rings[0].empty()) return 0;
  return 2 * glm::dot(difference(face.rings[0][0], from), area_vector(face));
}

FaceTriangles triangulate_face(const GridFace& face) {
  FaceTriangles out;
  const glm::dvec3 area = area_vector(face), size = glm::abs(area);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  Polygon polygon;
  std::vector<uint32_t> corners;  // corners of the face, in the order of those of the polygon
  std::vector<Ring> rings;
  for (const auto& ring : face.rings) {
    Ring& flat = rings.emplace_back();
    for (const GridCorner& p : ring) flat.push_back(flattened(p, axis));
  }
  if (rings.empty()) return {{}, "surface without a ring", false, 0};
  polygon.outer = rings[0];
  polygon.holes.assign(rings.begin() + 1, rings.end());
  out.fault = fault(polygon);
  out.crossing = out.fault == crossing_outline;
  if (!out.fault.empty() && !out.crossing) return out;
  const bool turned = twice_area(polygon.outer) < 0;
  for (size_t k = 0; k < rings.size(); ++k) {
    Ring& flat = k == 0 ? polygon.outer : polygon.holes[k - 1];
    const auto first = static_cast<std::ptrdiff_t>(corners.size());
    corners.resize(corners.size() + flat.size());
    std::iota(corners.begin() + first, corners.end(), static_cast<uint32_t>(first));
    if ((twice_area(flat) < 0) == (k > 0)) continue;
    std::ranges::reverse(flat);
    std::reverse(corners.begin() + first, corners.end());
  }
  for (const Triangle& t : triangulate(polygon)) {
    const Triangle own{corners[t[0]], corners[t[1]], corners[t[2]]};
    out.triangles.push_back(turned ? Triangle{own[0], own[2], own[1]} : own);
  }
  if (!out.triangles.empty()) {
    out.fault = {};
    out.bend_m = bend(face, glm::normalize(area));
  } else if (out.fault.empty()) {
    out.fault = "outline that could not be triangulated";
  }
  return out;
}

}  // namespace wavetracer::imports
