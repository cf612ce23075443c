// SPDX-License-Identifier: Apache-2.0
// An independent implementation of the string over the roofs: the profile over a line by all edges, its hull by
// sorting, and the shortest way over edges by bisection at one place after the other.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "reference/wedge_points.hpp"
#include "wavetracer/device/records.h"
#include "wavetracer/scene.hpp"

namespace wavetracer::test {

using Points = std::vector<glm::dvec3>;

struct Chain {
  std::vector<uint32_t> wedges;
  Points points;
};
inline double apart(const Points& a, const Points& b) {
  double most = 0;
  for (size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::distance(a[i], b[i]));
  return most;
}

inline double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

struct ProfilePoint {
  double along, height;
  uint32_t wedge;
};

// The points where edges cross the upright surface over a bent line, and the upper hull of these points and both ends.
inline std::vector<uint32_t> hull_over(const Scene& scene, const Points& line) {
  std::vector<ProfilePoint> profile;
  double before = 0;
  for (size_t k = 0; k + 1 < line.size(); ++k) {
    const glm::dvec2 p(line[k]), way = glm::dvec2(line[k + 1]) - p;
    for (uint32_t w = 0; w < scene.wedges.size(); ++w) {
      const glm::dvec3 from = scene.wedges[w].start, along = scene.wedges[w].length_m * scene.wedges[w].along;
      const double det = cross(way, glm::dvec2(along));
      const double s = cross(glm::dvec2(from) - p, glm::dvec2(along)) / det, u = cross(glm::dvec2(from) - p, way) / det;
      if (s > -1e-9 && s < 1 + 1e-9 && u >= 0 && u <= 1)
        profile.push_back({before + s * glm::length(way), from.z + u * along.z, w});
    }
    before += glm::length(way);
  }
  profile.push_back({0, line.front().z, WT_NONE});
  profile.push_back({before, line.back().z, WT_NONE});
  std::ranges::sort(profile, [](const ProfilePoint& a, const ProfilePoint& b) { return a.along < b.along; });
  std::vector<ProfilePoint> hull;
  for (const ProfilePoint& c : profile) {
    while (hull.size() > 1 &&
           cross({hull.back().along - hull.end()[-2].along, hull.back().height - hull.end()[-2].height},
                 {c.along - hull.back().along, c.height - hull.back().height}) >= 0)
      hull.pop_back();
    hull.push_back(c);
  }
  std::vector<uint32_t> out;
  for (size_t i = 1; i + 1 < hull.size(); ++i)
    if (out.empty() || out.back() != hull[i].wedge) out.push_back(hull[i].wedge);
  return out;
}

// Bisects each point between its neighbours until none moves. Edges are extended so that no point leaves them.
inline Points shortest(const Scene& scene, const std::vector<uint32_t>& wedges, const glm::dvec3& a,
                       const glm::dvec3& b) {
  std::vector<Wedge> lines;
  Points points{a};
  for (const uint32_t w : wedges) {
    Wedge line = scene.wedges[w];
    line.start -= 2000.0 * line.along;
    line.length_m += 4000;
    points.push_back(scene.wedges[w].start + 0.5 * scene.wedges[w].length_m * line.along);
    lines.push_back(line);
  }
  points.push_back(b);
  double moved = 1;
  for (int sweep = 0; sweep < 20000 && moved > 1e-12; ++sweep) {
    moved = 0;
    for (size_t i = 0; i < lines.size(); ++i)
      if (const auto p = reference::diffraction_point(lines[i], points[i], points[i + 2])) {
        moved = std::max(moved, glm::distance(*p, points[i + 1]));
        points[i + 1] = *p;
      }
  }
  return points;
}

inline bool on_edge(const Wedge& w, const glm::dvec3& p) {
  const double at = glm::dot(p - w.start, w.along);
  return at > 0 && at < w.length_m;
}

// Returns the edges that the string settles on; no wedges if it does not within eight pulls, or leaves an edge.
inline Chain expected(const Scene& scene, const glm::dvec3& a, const glm::dvec3& b, uint32_t most) {
  Points line{a, b};
  std::vector<uint32_t> wedges;
  for (int pull = 0; pull < 8; ++pull) {
    const std::vector<uint32_t> hull = hull_over(scene, line);
    if (hull.empty() || hull.size() > most) return {};
    if (hull == wedges) {
      for (size_t i = 0; i < hull.size(); ++i)
        if (!on_edge(scene.wedges[hull[i]], line[i + 1])) return {};
      return {wedges, Points(line.begin() + 1, line.end() - 1)};
    }
    wedges = hull;
    line = shortest(scene, wedges, a, b);
  }
  return {};
}

}  // namespace wavetracer::test
