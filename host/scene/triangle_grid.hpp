// SPDX-License-Identifier: Apache-2.0
// The triangles of a scene, sorted into the cells of a grid: it finds the triangles that a line meets, and those near a
// place. Coordinates must be recentred, and triangles must not change; the scene must outlive this object.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene_grid.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns the box around triangle t, extended by reach_m on all sides.
SceneBox triangle_box(const Scene& scene, uint32_t t, double reach_m);

class TriangleGrid {
 public:
  // reach_m: every box is extended by this on all sides.
  explicit TriangleGrid(const Scene& scene, double reach_m = 0);

  struct Crossing {
    double distance_m;  // distance from the line's start
    uint32_t triangle;
  };
  // Returns all triangles that the line from a to b meets, the nearest first. A line through the edge between two
  // triangles meets one or both of them, never none.
  std::vector<Crossing> crossings(const glm::dvec3& a, const glm::dvec3& b) const;

  const SceneGrid& grid() const { return grid_; }
  std::span<const uint32_t> operator[](uint32_t cell) const { return triangles_[cell]; }
  const std::vector<SceneBox>& boxes() const { return boxes_; }  // one per triangle
  const SceneBox& bounds() const { return bounds_; }             // box around all triangles

 private:
  const Scene& scene_;
  std::vector<SceneBox> boxes_;
  SceneBox bounds_;
  SceneGrid grid_;
  CellLists triangles_;
};

}  // namespace wavetracer
