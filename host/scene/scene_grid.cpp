// SPDX-License-Identifier: Apache-2.0
// The grid halves its cells until memory would grow; lists are sorted by counting.
// A line is cut into layers of cells, a layer into rows, and a row into cells.
#include "scene/scene_grid.hpp"

#include <cmath>
#include <glm/common.hpp>

namespace wavetracer {
namespace {

constexpr double cells_a_box = 8;

}  // namespace

SceneGrid::SceneGrid(std::span<const SceneBox> boxes) {
  if (boxes.empty()) return;
  lower_ = boxes[0].lower;
  glm::dvec3 upper = boxes[0].upper;
  for (const SceneBox& box : boxes) {
    lower_ = glm::min(lower_, box.lower);
    upper = glm::max(upper, box.upper);
  }
  const glm::dvec3 extent_m = upper - lower_;
  const double limit = cells_a_box * static_cast<double>(boxes.size());
  const auto fits = [&](double cell_m) {
    const glm::dvec3 counts = glm::floor(extent_m / cell_m) + 1.0;
    if (counts.x * counts.y * counts.z > limit) return false;
    double sum = 0;
    for (const SceneBox& box : boxes) {
      const glm::dvec3 first = glm::floor((box.lower - lower_) / cell_m);
      const glm::dvec3 cells = glm::floor((box.upper - lower_) / cell_m) - first + 1.0;
      sum += cells.x * cells.y * cells.z;
    }
    return sum <= limit;
  };
  const double longest_m = std::max({extent_m.x, extent_m.y, extent_m.z});
  if (!(longest_m > 0)) return;
  cell_m_ = longest_m;
  while (fits(cell_m_ / 2)) cell_m_ /= 2;
  counts_ = glm::i64vec3(glm::floor(extent_m / cell_m_)) + int64_t{1};
}

std::pair<int64_t, int64_t> SceneGrid::cells_of(const Line& line, int axis, const Interval& part) const {
  const double a = line.start[axis] + line.way[axis] * part.first, b = line.start[axis] + line.way[axis] * part.second;
  return {cell(axis, std::min(a, b) - line.reach_m), cell(axis, std::max(a, b) + line.reach_m)};
}

SceneGrid::Interval SceneGrid::part_in(const Line& line, int axis, int64_t cell, const Interval& part) const {
  const double way = line.way[axis];
  if (std::abs(way) <= line.reach_m) return part;  // the whole line is in this layer, up to the reach
  const double from = lower_[axis] + static_cast<double>(cell) * cell_m_ - line.start[axis];
  const double a = (from - line.reach_m) / way, b = (from + cell_m_ + line.reach_m) / way;
  return {std::clamp(std::min(a, b), part.first, part.second), std::clamp(std::max(a, b), part.first, part.second)};
}

CellLists::CellLists(size_t cells, std::span<const Entry> entries) : first_(cells + 1, 0), items_(entries.size()) {
  for (const Entry& entry : entries) ++first_[entry.cell + 1];
  for (size_t c = 0; c < cells; ++c) first_[c + 1] += first_[c];
  std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
  for (const Entry& entry : entries) items_[next[entry.cell]++] = entry.item;
}

CellLists lists_of(const SceneGrid& grid, std::span<const SceneBox> boxes) {
  std::vector<CellLists::Entry> entries;
  for (uint32_t i = 0; i < boxes.size(); ++i)
    grid.visit_box(boxes[i], [&](uint32_t cell) { entries.push_back({cell, i}); });
  return {grid.size(), entries};
}

}  // namespace wavetracer
