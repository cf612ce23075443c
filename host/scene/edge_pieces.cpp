// SPDX-License-Identifier: Apache-2.0
// Joints are the welded ends and crossings of edges; each edge is then cut at the joints that lie on it.
// Edges and joints are compared within the cells of a grid, so the work is that of neighbours.
#include "scene/edge_pieces.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "scene/weld.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
// Edges within 1 mrad of each other do not cross: they touch at an end, or not at all.
constexpr double parallel_sine2 = 1e-6;

struct Line {
  uint32_t edge;
  dvec3 start, end, along;  // along: unit vector
  double length_m;
};

struct Stop {
  double at_m;  // distance from the start of the line
  uint32_t joint;
};

// A line between two joints; pieces of several lines share a key.
struct Cut {
  uint64_t key;  // both joints, the lower one above
  uint32_t line;
  double from_m, to_m;  // places of the lower joint and of the other one, from the start of the line
};

std::vector<Line> lines_of(const Scene& scene) {
  std::vector<Line> lines;
  for (uint32_t e = 0; e < scene.edges.size(); ++e) {
    if (scene.edges[e].flat) continue;
    const auto& [a, b] = scene.edges[e].vertices;
    const dvec3 way = scene.vertices[b] - scene.vertices[a];
    const double length_m = glm::length(way);
    lines.push_back({e, scene.vertices[a], scene.vertices[b], way / length_m, length_m});
  }
  return lines;
}

// Returns the point of a that is nearest to b, if they pass each other between their ends.
std::optional<dvec3> crossing(const Line& a, const Line& b) {
  const double cosine = glm::dot(a.along, b.along), sine2 = 1 - cosine * cosine;
  if (sine2 < parallel_sine2) return std::nullopt;
  const dvec3 between = b.start - a.start;
  const double to_a = glm::dot(between, a.along), to_b = glm::dot(between, b.along);
  const double on_a_m = (to_a - cosine * to_b) / sine2, on_b_m = (cosine * to_a - to_b) / sine2;
  if (on_a_m < touch_m || on_a_m > a.length_m - touch_m || on_b_m < touch_m || on_b_m > b.length_m - touch_m)
    return std::nullopt;
  const dvec3 point = a.start + a.along * on_a_m;
  if (glm::distance(point, b.start + b.along * on_b_m) > touch_m) return std::nullopt;
  return point;
}

// Returns both ends of every line, then the points where lines cross.
std::vector<dvec3> find_places(std::span<const Line> lines, const SceneGrid& grid) {
  std::vector<dvec3> places;
  std::vector<CellLists::Entry> entries;
  for (uint32_t i = 0; i < lines.size(); ++i) {
    places.push_back(lines[i].start);
    places.push_back(lines[i].end);
    grid.visit_line(lines[i].start, lines[i].end, touch_m, [&](uint32_t cell) { entries.push_back({cell, i}); });
  }
  const CellLists lists(grid.size(), entries);
  for (uint32_t cell = 0; cell < grid.size(); ++cell) {
    const std::span<const uint32_t> here = lists[cell];
    for (size_t i = 1; i < here.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        const std::optional<dvec3> point = crossing(lines[here[i]], lines[here[j]]);
        if (point && grid.cell_at(*point) == cell) places.push_back(*point);
      }
    }
  }
  return places;
}

std::vector<Cut> cut_lines(std::span<const Line> lines, const SceneGrid& grid, const Weld& joints) {
  std::vector<CellLists::Entry> entries;
  for (uint32_t j = 0; j < joints.positions.size(); ++j) entries.push_back({grid.cell_at(joints.positions[j]), j});
  const CellLists lists(grid.size(), entries);
  std::vector<Cut> cuts;
  std::vector<Stop> stops;
  for (uint32_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    const uint32_t first = joints.vertex[2 * i], last = joints.vertex[2 * i + 1];
    if (first == last) continue;
    stops.clear();
    grid.visit_line(line.start, line.end, touch_m, [&](uint32_t cell) {
      for (const uint32_t j : lists[cell]) {
        const dvec3 p = joints.positions[j] - line.start;
        const double at_m = glm::dot(p, line.along);
        if (j == first || j == last || at_m < touch_m || at_m > line.length_m - touch_m) continue;
        if (glm::length(p - line.along * at_m) <= touch_m) stops.push_back({at_m, j});
      }
    });
    std::sort(stops.begin(), stops.end(),
              [](const Stop& a, const Stop& b) { return a.at_m != b.at_m ? a.at_m < b.at_m : a.joint < b.joint; });
    stops.push_back({line.length_m, last});
    Stop from{0, first};
    for (const Stop& to : stops) {
      if (to.at_m - from.at_m < touch_m && to.joint != last) continue;  // too near to the joint before
      const auto [low, high] = std::minmax(from.joint, to.joint);
      const bool turned = to.joint == low;
      cuts.push_back({uint64_t{low} << 32 | high, i, turned ? to.at_m : from.at_m, turned ? from.at_m : to.at_m});
      from = to;
    }
  }
  return cuts;
}

EdgePiece piece_of(const Cut& cut, const Line& line) {
  const auto at = [&line](double t_m) { return t_m == line.length_m ? line.end : line.start + line.along * t_m; };
  return {.joints = {static_cast<uint32_t>(cut.key >> 32), static_cast<uint32_t>(cut.key)},
          .start = at(cut.from_m),
          .end = at(cut.to_m),
          .along = cut.to_m > cut.from_m ? line.along : -line.along};
}

}  // namespace

EdgePieces split_edges(const Scene& scene, const SceneGrid& grid) {
  const std::vector<Line> lines = lines_of(scene);
  std::vector<Cut> cuts = cut_lines(lines, grid, weld_vertices(find_places(lines, grid), touch_m));
  std::sort(cuts.begin(), cuts.end(), [&lines](const Cut& a, const Cut& b) {
    if (a.key != b.key) return a.key < b.key;
    const double a_m = lines[a.line].length_m, b_m = lines[b.line].length_m;
    return a_m != b_m ? a_m > b_m : a.line < b.line;
  });
  EdgePieces out;
  for (size_t i = 0; i < cuts.size(); ++i) {
    const Line& line = lines[cuts[i].line];
    if (i == 0 || cuts[i].key != cuts[i - 1].key) {
      out.pieces.push_back(piece_of(cuts[i], line));
      out.pieces.back().first_edge = static_cast<uint32_t>(i);
    }
    ++out.pieces.back().edge_count;
    out.edges.push_back(line.edge);
  }
  return out;
}

}  // namespace wavetracer
