// SPDX-License-Identifier: Apache-2.0
// Ends are sorted by the cells of a grid, so that each meets its neighbours only.
#include "scene/free_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "scene/edge_pieces.hpp"
#include "scene/triangle_grid.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {
namespace {

using glm::dvec3;

constexpr double beside_m = 0.01;      // a surface is looked for so far beside an edge, and beyond its end
constexpr double straight = 1 - 5e-7;  // cosine of 1 mrad

struct EdgeEnd {
  dvec3 at, out;  // out: a unit vector from the end, away from the edge
  uint32_t wedge;
};

EdgeEnd end_of(const Scene& scene, uint32_t wedge, bool last) {
  const Wedge& w = scene.wedges[wedge];
  return {last ? w.start + w.along * w.length_m : w.start, last ? w.along : -w.along, wedge};
}

// Does the line beside the edge, in the middle of its free space, meet a surface near the end?
bool runs_into_surface(const Wedge& wedge, const EdgeEnd& end, const TriangleGrid& triangles) {
  const double half_rad = wedge.exterior_rad / 2;
  const dvec3 middle = end.at + beside_m * (wedge.face * std::cos(half_rad) + wedge.normal * std::sin(half_rad));
  return !triangles.crossings(middle - beside_m * end.out, middle + beside_m * end.out).empty();
}

// Does another wedge go on where this end is?
bool goes_on(const EdgeEnd& end, std::span<const EdgeEnd> ends, const CellLists& lists, const SceneGrid& grid) {
  return std::ranges::any_of(lists[grid.cell_at(end.at)], [&](uint32_t other) {
    const EdgeEnd& next = ends[other];
    return next.wedge != end.wedge && glm::distance(next.at, end.at) <= touch_m &&
           glm::dot(next.out, end.out) < -straight;
  });
}

}  // namespace

void mark_free_ends(Scene& scene) {
  std::vector<EdgeEnd> ends;
  std::vector<SceneBox> boxes;
  for (uint32_t k = 0; k < scene.wedges.size(); ++k)
    for (const bool last : {false, true}) {
      ends.push_back(end_of(scene, k, last));
      boxes.push_back({ends.back().at - touch_m, ends.back().at + touch_m});
    }
  if (ends.empty()) return;
  const SceneGrid grid(boxes);
  const CellLists lists = lists_of(grid, boxes);
  const TriangleGrid triangles(scene);
  for (size_t k = 0; k < ends.size(); ++k) {
    Wedge& wedge = scene.wedges[ends[k].wedge];
    if (wedge.exterior_rad <= std::numbers::pi || wedge.length_m < beside_m) continue;
    if (goes_on(ends[k], ends, lists, grid) || runs_into_surface(wedge, ends[k], triangles)) continue;
    wedge.free_ends |= k % 2 == 0 ? WT_FREE_START : WT_FREE_END;
  }
}

}  // namespace wavetracer
