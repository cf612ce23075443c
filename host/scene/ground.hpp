// SPDX-License-Identifier: Apache-2.0
// The height of the ground of a scene, from which heights "above the ground" are measured.
// It copies what it needs from the scene.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "scene/scene_grid.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// The ground is the body, joined by edges, that spans at least half of the scene seen from above (half of the area of
// its bounding box). Floors of houses, which lie below it, do not count. If a scene has no such body, the ground is the
// lowest surface at each place.
class Ground {
 public:
  explicit Ground(const Scene& scene);
  // Takes these triangles as the ground.
  explicit Ground(std::vector<std::array<glm::dvec3, 3>> triangles);

  // Returns the lowest z of the ground at a place, both in file coordinates; nothing where there is no ground.
  std::optional<double> height_m(const glm::dvec2& place_m) const;

 private:
  void index();

  std::vector<std::array<glm::dvec3, 3>> triangles_;  // file coordinates, without vertical triangles
  std::optional<SceneGrid> grid_;                     // grid seen from above; absent without triangles
  std::optional<CellLists> cells_;
};

}  // namespace wavetracer
