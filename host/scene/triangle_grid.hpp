// The triangles of a scene, sorted into the cells of a grid: which a line meets, and which are near a place.
// Assumes recentred coordinates and triangles that do not change; the scene must outlive this.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene_grid.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// The box around triangle t, wider by so much on all sides.
SceneBox triangle_box(const Scene& scene, uint32_t t, double reach_m);

class TriangleGrid {
 public:
  // reach_m: every box is wider by so much on all sides.
  explicit TriangleGrid(const Scene& scene, double reach_m = 0);

  struct Crossing {
    double distance_m;  // from the line's start
    uint32_t triangle;
  };
  // All triangles that the line from a to b meets, the nearest first. One that goes through an edge between two meets
  // both of them, or one: never none.
  std::vector<Crossing> crossings(const glm::dvec3& a, const glm::dvec3& b) const;

  const SceneGrid& grid() const { return grid_; }
  std::span<const uint32_t> operator[](uint32_t cell) const { return triangles_[cell]; }
  const std::vector<SceneBox>& boxes() const { return boxes_; }  // one per triangle
  const SceneBox& bounds() const { return bounds_; }             // of them all

 private:
  const Scene& scene_;
  std::vector<SceneBox> boxes_;
  SceneBox bounds_;
  SceneGrid grid_;
  CellLists triangles_;
};

}  // namespace wavetracer
