// How high the ground of a scene is: what heights "above the ground" are measured from.
// Keeps what it needs of the scene, which may go.
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

// The ground is what edges join to a body that spans at least half of the scene, seen from above (half of the area of
// the box around it): so floors of houses, which lie below it, are none. Where a scene has no such body, it is the
// lowest surface at each place.
class Ground {
 public:
  explicit Ground(const Scene& scene);
  // Of these triangles.
  explicit Ground(std::vector<std::array<glm::dvec3, 3>> triangles);

  // Its lowest z at a place, both in file coordinates; empty where there is none.
  std::optional<double> height_m(const glm::dvec2& place_m) const;

 private:
  void index();

  std::vector<std::array<glm::dvec3, 3>> triangles_;  // file coordinates, those that are not vertical
  std::optional<SceneGrid> grid_;                     // seen from above; none without triangles
  std::optional<CellLists> cells_;
};

}  // namespace wavetracer
