// SPDX-License-Identifier: Apache-2.0
// Edges are visited twice: first counted, then entered. Cells and lists are arrays of a device, so they are no
// SceneGrid.
#include "passes/wedge_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace wavetracer {
namespace {

constexpr double whole_turn_rad = 2 * std::numbers::pi - 1e-6;  // half planes have at least this angle
constexpr double most_cells = 1 << 20;
constexpr double margin_m = 1e-3;  // for the rounding of both sides

struct Plan {
  glm::dvec2 from, to;
};

Plan plan_of(const wt_wedge& w) {
  const glm::dvec2 from{w.start[0], w.start[1]};
  return {from, from + w.length * glm::dvec2{w.along[0], w.along[1]}};
}

bool stands_up(const wt_wedge& w, bool free_edges) {
  return w.exterior > std::numbers::pi && (free_edges || w.exterior <= whole_turn_rad);
}

bool has_plan(const wt_wedge& w) { return w.length * std::hypot(w.along[0], w.along[1]) > margin_m; }

double reach_of(const wt_wedge& w) {
  const glm::dvec3 from{w.start[0], w.start[1], w.start[2]};
  const glm::dvec3 to = from + w.length * glm::dvec3{w.along[0], w.along[1], w.along[2]};
  return std::max(glm::length(from), glm::length(to));
}

// Visits the cells that an edge touches, in rows and columns.
template <class Act>
void visit_cells(const wt_edge_map_arguments& map, const wt_wedge& wedge, const Act& act) {
  const auto [from, to] = plan_of(wedge);
  const glm::dvec2 origin{map.origin[0], map.origin[1]};
  const auto cell = [&](double at, int axis, uint32_t count) {
    return static_cast<uint32_t>(std::clamp(std::floor((at - origin[axis]) / map.cell_m), 0.0, count - 1.0));
  };
  const glm::dvec2 low = glm::min(from, to) - margin_m, high = glm::max(from, to) + margin_m;
  for (uint32_t row = cell(low.y, 1, map.rows); row <= cell(high.y, 1, map.rows); ++row)
    for (uint32_t column = cell(low.x, 0, map.columns); column <= cell(high.x, 0, map.columns); ++column) {
      const glm::dvec2 centre = origin + map.cell_m * (glm::dvec2{column, row} + 0.5);
      if (touches_cell(from, to, centre, 0.5 * map.cell_m, margin_m)) act(row * map.columns + column);
    }
}

wt_edge_map_arguments grid_over(const std::vector<wt_wedge>& wedges, const std::vector<uint32_t>& counting) {
  wt_edge_map_arguments out{};
  out.cell_m = 1;
  if (counting.empty()) return out;
  glm::dvec2 low(INFINITY), high(-INFINITY);
  for (const uint32_t k : counting) {
    const auto [from, to] = plan_of(wedges[k]);
    low = glm::min(low, glm::min(from, to));
    high = glm::max(high, glm::max(from, to));
  }
  low -= margin_m;
  high += margin_m;
  const glm::dvec2 size = high - low;
  const double cells = std::clamp(static_cast<double>(counting.size()), 1.0, most_cells / 4);
  // For a line of edges one row of cells is enough.
  out.cell_m = std::max(std::sqrt(size.x * size.y / cells), std::max(size.x, size.y) / cells);
  out.origin[0] = low.x;
  out.origin[1] = low.y;
  out.columns = static_cast<uint32_t>(size.x / out.cell_m) + 1;
  out.rows = static_cast<uint32_t>(size.y / out.cell_m) + 1;
  return out;
}

bool is_upright(const wt_wedge& w) { return std::abs(w.along[2]) > 0.99; }

glm::dvec3 end_of(const wt_wedge& w, int end) {
  const glm::dvec3 from{w.start[0], w.start[1], w.start[2]};
  return end == 0 ? from : from + w.length * glm::dvec3{w.along[0], w.along[1], w.along[2]};
}

// A cell of 2 mm of one instance; a point has the cell that it is in and its neighbours.
using Corner = std::array<int64_t, 4>;
Corner corner_at(const wt_wedge& w, const glm::dvec3& p, const glm::ivec3& beside) {
  Corner out{w.instance};
  for (int axis = 0; axis < 3; ++axis)
    out[static_cast<size_t>(axis) + 1] = static_cast<int64_t>(std::floor(p[axis] / 2e-3)) + beside[axis];
  return out;
}

std::vector<uint32_t> uprights_of(const std::vector<wt_wedge>& wedges, bool free_edges) {
  std::map<Corner, uint32_t> corners;
  for (uint32_t k = 0; k < wedges.size(); ++k)
    if (stands_up(wedges[k], free_edges) && is_upright(wedges[k]))
      for (const int end : {0, 1}) corners.emplace(corner_at(wedges[k], end_of(wedges[k], end), {0, 0, 0}), k);
  std::vector<uint32_t> out;
  for (const wt_wedge& w : wedges)
    for (const int end : {0, 1}) {
      uint32_t found = WT_NONE;
      for (int at = 0; at < 27 && !corners.empty(); ++at) {
        const auto it = corners.find(corner_at(w, end_of(w, end), {at % 3 - 1, at / 3 % 3 - 1, at / 9 - 1}));
        if (it != corners.end()) found = std::min(found, it->second);
      }
      out.push_back(found);
    }
  return out;
}

}  // namespace

bool touches_cell(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& centre, double half, double margin) {
  const glm::dvec2 a = from - centre, b = to - centre, along = b - a;
  const double reach = half + margin;
  for (int axis = 0; axis < 2; ++axis)
    if (std::min(a[axis], b[axis]) > reach || std::max(a[axis], b[axis]) < -reach) return false;
  const double beside = std::abs(along.x * a.y - along.y * a.x);
  return beside <= reach * (std::abs(along.x) + std::abs(along.y));
}

WedgeGrid::WedgeGrid(const std::vector<wt_wedge>& wedges, uint32_t static_count, uint32_t instance_count,
                     bool free_edges) {
  std::vector<uint32_t> counting;
  for (uint32_t k = 0; k < static_count; ++k)
    if (stands_up(wedges[k], free_edges) && has_plan(wedges[k])) counting.push_back(k);
  map = grid_over(wedges, counting);
  map.instance_count = instance_count;
  const uint32_t cells = map.columns * map.rows;
  radii_m.assign(std::max(instance_count, 1u), 0.0);
  first.assign(size_t{cells} + instance_count + 1, 0);
  const auto visit = [&](const auto& act) {
    for (const uint32_t k : counting) visit_cells(map, wedges[k], [&](uint32_t cell) { act(cell, k); });
    for (auto k = static_count; k < wedges.size(); ++k)
      if (stands_up(wedges[k], free_edges)) act(cells + wedges[k].instance, k);
  };
  std::vector<uint32_t> next(first.size(), 0);
  visit([&](uint32_t list, uint32_t k) {
    ++next[list];
    if (list >= cells) radii_m[list - cells] = std::max(radii_m[list - cells], reach_of(wedges[k]));
  });
  std::exclusive_scan(next.begin(), next.end(), first.begin(), 0u);
  next = first;
  uprights = uprights_of(wedges, free_edges);
  listed.resize(first.back());
  visit([&](uint32_t list, uint32_t k) { listed[next[list]++] = k; });
}

}  // namespace wavetracer
