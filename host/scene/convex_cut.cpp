// SPDX-License-Identifier: Apache-2.0
// Clips by Sutherland and Hodgman (1974), and keeps the outer part as well.
#include "scene/convex_cut.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "scene/weld.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;

// Returns the point where the line is crossed, always computed from the inner end: both polygons at a side get the same
// point.
dvec3 on_cut_line(const dvec3& inner, double inner_m, const dvec3& outer, double outer_m) {
  return inner + (outer - inner) * (inner_m / (inner_m - outer_m));
}

double triangle_height_m(const dvec3& a, const dvec3& b, const dvec3& c) {
  const double longest_m = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  return longest_m > 0 ? glm::length(glm::cross(b - a, c - a)) / longest_m : 0;
}

// Tells whether a side of triangle t, in a plane with this normal, has the other triangle entirely on its outer side,
// up to touch_m.
bool parted_by_a_side(const Scene& scene, uint32_t t, uint32_t other, const dvec3& normal, double touch_m) {
  return std::ranges::any_of(side_lines(scene, t, normal), [&](const CutLine& side) {
    return std::ranges::all_of(scene.triangles[other],
                               [&](uint32_t v) { return side.beyond_m(scene.vertices[v]) <= touch_m; });
  });
}

}  // namespace

double CutLine::beyond_m(const dvec3& p) const { return glm::dot(inwards, p) - offset_m; }

std::array<CutLine, 3> side_lines(const Scene& scene, uint32_t t, const dvec3& normal) {
  std::array<CutLine, 3> out;
  const auto corner = [&](size_t k) { return scene.vertices[scene.triangles[t][k % 3]]; };
  for (size_t k = 0; k < 3; ++k) {
    const dvec3 a = corner(k), across = glm::normalize(glm::cross(normal, corner(k + 1) - a));
    const dvec3 inwards = glm::dot(across, corner(k + 2) - a) < 0 ? -across : across;
    out[k] = {inwards, glm::dot(inwards, a)};
  }
  return out;
}

bool overlap_in_plane(const Scene& scene, uint32_t t, const dvec3& normal, uint32_t other, const dvec3& other_normal) {
  return !parted_by_a_side(scene, t, other, normal, weld_tolerance_m) &&
         !parted_by_a_side(scene, other, t, other_normal, weld_tolerance_m);
}

CutParts cut_convex(const ConvexPolygon& polygon, const CutLine& line, double touch_m) {
  std::vector<double> beyond_m;
  for (const dvec3& p : polygon) {
    const double d_m = line.beyond_m(p);
    beyond_m.push_back(std::abs(d_m) <= touch_m ? 0 : d_m);
  }
  if (std::ranges::none_of(beyond_m, [](double d_m) { return d_m > 0; })) return {polygon, {}};
  if (std::ranges::none_of(beyond_m, [](double d_m) { return d_m < 0; })) return {{}, polygon};
  CutParts out;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const size_t next = (i + 1) % polygon.size();
    const double here_m = beyond_m[i], there_m = beyond_m[next];
    if (here_m >= 0) out.inside.push_back(polygon[i]);
    if (here_m <= 0) out.outside.push_back(polygon[i]);
    if (!(here_m > 0 && there_m < 0) && !(here_m < 0 && there_m > 0)) continue;
    const dvec3 p =
        here_m > 0 ? on_cut_line(polygon[i], line.beyond_m(polygon[i]), polygon[next], line.beyond_m(polygon[next]))
                   : on_cut_line(polygon[next], line.beyond_m(polygon[next]), polygon[i], line.beyond_m(polygon[i]));
    out.inside.push_back(p);
    out.outside.push_back(p);
  }
  return out;
}

double polygon_area_m2(const ConvexPolygon& polygon) {
  double sum_m2 = 0;
  for (size_t i = 2; i < polygon.size(); ++i)
    sum_m2 += glm::length(glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0])) / 2;
  return sum_m2;
}

double polygon_width_m(const ConvexPolygon& polygon) {
  if (polygon.size() < 3) return 0;
  double least_m = std::numeric_limits<double>::max();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 &a = polygon[i], along = polygon[(i + 1) % polygon.size()] - a;
    const double length_m = glm::length(along);
    if (!(length_m > 0)) continue;
    double most_m = 0;
    for (const dvec3& p : polygon) most_m = std::max(most_m, glm::length(glm::cross(along, p - a)) / length_m);
    least_m = std::min(least_m, most_m);
  }
  return least_m;
}

std::vector<std::array<size_t, 3>> best_fan(const ConvexPolygon& polygon) {
  const size_t n = polygon.size();
  std::vector<std::array<size_t, 3>> best, fan;
  double highest_m = -1;
  for (size_t first = 0; first < n; ++first) {
    fan.clear();
    double lowest_m = std::numeric_limits<double>::max();
    for (size_t i = 1; i + 1 < n; ++i) {
      fan.push_back({first, (first + i) % n, (first + i + 1) % n});
      const auto& [a, b, c] = fan.back();
      lowest_m = std::min(lowest_m, triangle_height_m(polygon[a], polygon[b], polygon[c]));
    }
    if (lowest_m <= highest_m) continue;
    highest_m = lowest_m;
    best = fan;
  }
  return best;
}

}  // namespace wavetracer
