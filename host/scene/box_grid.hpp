// SPDX-License-Identifier: Apache-2.0
// Finds the boxes that a place is in or near: boxes that do not move, listed by the cells of a SceneGrid.
// That grid is the index of all host code that asks what is at a place or along a line; triangle_grid.hpp asks it for
// triangles. Two others ask something else: weld.cpp has cells of the size of a tolerance, and points come one by one;
// passes/wedge_grid.cpp writes the lists that a kernel walks through.
#pragma once
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

#include "scene/scene_grid.hpp"

namespace wavetracer {

class BoxGrid {
 public:
  // Boxes must be finite.
  explicit BoxGrid(std::vector<SceneBox> boxes)
      : boxes_(std::move(boxes)), grid_(boxes_), lists_(lists_of(grid_, boxes_)) {}

  // Calls visit(number) once for every box that the point is in, or at most margin_m beside along each axis. Numbers
  // ascend if the margin is 0.
  template <class Visit>
  void at(const glm::dvec3& p, double margin_m, const Visit& visit) const {
    const SceneBox around{p - margin_m, p + margin_m};
    grid_.visit_box(around, [&](uint32_t cell) {
      for (const uint32_t k : lists_[cell]) {
        const SceneBox& box = boxes_[k];
        // A box that overlaps several of these cells is seen in the one where both boxes begin.
        if (glm::all(glm::lessThanEqual(box.lower, around.upper)) &&
            glm::all(glm::lessThanEqual(around.lower, box.upper)) &&
            grid_.cell_at(glm::max(box.lower, around.lower)) == cell)
          visit(k);
      }
    });
  }

 private:
  std::vector<SceneBox> boxes_;
  SceneGrid grid_;
  CellLists lists_;
};

}  // namespace wavetracer
