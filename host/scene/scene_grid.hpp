// SPDX-License-Identifier: Apache-2.0
// A uniform grid over a scene, and lists of the items in its cells.
// Positions must be finite and within the boxes that the grid was made for.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace wavetracer {

// An axis-aligned box in metres.
struct SceneBox {
  glm::dvec3 lower, upper;
  void grow(const SceneBox& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
  }
  double plan_area_m2() const { return (upper.x - lower.x) * (upper.y - lower.y); }  // seen from above
};

class SceneGrid {
 public:
  // Cells are as small as possible while neither their number nor the sum of cells over all boxes exceeds 8 per box, so
  // memory stays linear for any boxes.
  explicit SceneGrid(std::span<const SceneBox> boxes);

  size_t size() const { return static_cast<size_t>(counts_[0] * counts_[1] * counts_[2]); }
  uint32_t cell_at(const glm::dvec3& p) const { return number(cell(0, p.x), cell(1, p.y), cell(2, p.z)); }

  // Calls visit(cell) for the cells that a box overlaps.
  template <class Visit>
  void visit_box(const SceneBox& box, const Visit& visit) const {
    for (int64_t z = cell(2, box.lower.z); z <= cell(2, box.upper.z); ++z) {
      for (int64_t y = cell(1, box.lower.y); y <= cell(1, box.upper.y); ++y) {
        for (int64_t x = cell(0, box.lower.x); x <= cell(0, box.upper.x); ++x) visit(number(x, y, z));
      }
    }
  }

  // Does the same for a line from a to b, with everything within reach_m of it.
  template <class Visit>
  void visit_line(const glm::dvec3& a, const glm::dvec3& b, double reach_m, const Visit& visit) const {
    const Line line{a, b - a, reach_m};
    const auto [x_low, x_high] = cells_of(line, 0, {0, 1});
    for (int64_t x = x_low; x <= x_high; ++x) {
      const Interval in_x = part_in(line, 0, x, {0, 1});
      const auto [y_low, y_high] = cells_of(line, 1, in_x);
      for (int64_t y = y_low; y <= y_high; ++y) {
        const auto [z_low, z_high] = cells_of(line, 2, part_in(line, 1, y, in_x));
        for (int64_t z = z_low; z <= z_high; ++z) visit(number(x, y, z));
      }
    }
  }

 private:
  using Interval = std::pair<double, double>;  // an interval of the line's parameter, 0 to 1
  struct Line {
    glm::dvec3 start, way;
    double reach_m;
  };

  int64_t cell(int axis, double x) const {
    const auto i = static_cast<int64_t>((x - lower_[axis]) / cell_m_);
    return std::clamp<int64_t>(i, 0, counts_[axis] - 1);
  }
  uint32_t number(int64_t x, int64_t y, int64_t z) const {
    return static_cast<uint32_t>((z * counts_[1] + y) * counts_[0] + x);
  }
  std::pair<int64_t, int64_t> cells_of(const Line& line, int axis, const Interval& part) const;
  Interval part_in(const Line& line, int axis, int64_t cell, const Interval& part) const;

  glm::dvec3 lower_{0};
  glm::i64vec3 counts_{1};
  double cell_m_ = 1;
};

// Items by cell; within a cell they keep the order in which they were added.
class CellLists {
 public:
  struct Entry {
    uint32_t cell, item;
  };
  CellLists(size_t cells, std::span<const Entry> entries);
  std::span<const uint32_t> operator[](uint32_t cell) const {
    return {items_.data() + first_[cell], items_.data() + first_[cell + 1]};
  }

 private:
  std::vector<uint32_t> first_, items_;
};

// Lists the numbers of the boxes that overlap each cell.
CellLists lists_of(const SceneGrid& grid, std::span<const SceneBox> boxes);

}  // namespace wavetracer
