// SPDX-License-Identifier: Apache-2.0
// Triangles seen from above are kept in the cells of a grid with one layer.
// Neighbouring triangles decide with the same numbers on which side of their edge a place lies, so no place falls
// between them.
#include "scene/ground.hpp"

#include <algorithm>

#include "scene/topology.hpp"

namespace wavetracer {
namespace {

double twice_plan_area(const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; }

SceneBox box_from_above(const std::array<glm::dvec3, 3>& t) {
  SceneBox box{glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2])};
  box.lower.z = box.upper.z = 0;
  return box;
}

std::vector<bool> wide_bodies(const Scene& scene, const std::vector<uint32_t>& body) {
  std::vector<SceneBox> boxes;
  for (size_t t = 0; t < body.size(); ++t) {
    const auto& c = scene.triangles[t];
    const SceneBox box = box_from_above({scene.vertices[c[0]], scene.vertices[c[1]], scene.vertices[c[2]]});
    if (body[t] == boxes.size())
      boxes.push_back(box);
    else
      boxes[body[t]].grow(box);
  }
  const double scene_area_m2 = SceneBox{scene.lower, scene.upper}.plan_area_m2();
  std::vector<bool> wide;
  for (const SceneBox& box : boxes) wide.push_back(box.plan_area_m2() >= 0.5 * scene_area_m2);
  return wide;
}

// Returns the z of the triangle at a place; nothing if the place is beside it.
std::optional<double> height_at(const std::array<glm::dvec3, 3>& t, const glm::dvec2& p) {
  const glm::dvec2 a = glm::dvec2(t[0]) - p, b = glm::dvec2(t[1]) - p, c = glm::dvec2(t[2]) - p;
  const double wa = twice_plan_area(b, c), wb = twice_plan_area(c, a), wc = twice_plan_area(a, b);
  const bool inside = (wa >= 0 && wb >= 0 && wc >= 0) || (wa <= 0 && wb <= 0 && wc <= 0);
  const double sum = wa + wb + wc;
  if (!inside || sum == 0) return {};
  return (wa * t[0].z + wb * t[1].z + wc * t[2].z) / sum;
}

}  // namespace

Ground::Ground(const Scene& scene) {
  const std::vector<uint32_t> body = bodies_of(scene);
  const std::vector<bool> wide = wide_bodies(scene, body);
  const bool any_wide = std::ranges::find(wide, true) != wide.end();
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    if (any_wide && !wide[body[t]]) continue;
    std::array<glm::dvec3, 3> corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = scene.origin_m + scene.vertices[scene.triangles[t][k]];
    triangles_.push_back(corners);
  }
  index();
}

Ground::Ground(std::vector<std::array<glm::dvec3, 3>> triangles) : triangles_(std::move(triangles)) { index(); }

void Ground::index() {
  std::erase_if(triangles_,
                [](const auto& t) { return twice_plan_area(glm::dvec2(t[1] - t[0]), glm::dvec2(t[2] - t[0])) == 0; });
  std::vector<SceneBox> boxes;
  for (const auto& corners : triangles_) boxes.push_back(box_from_above(corners));
  if (boxes.empty()) return;
  grid_.emplace(boxes);
  cells_ = lists_of(*grid_, boxes);
}

std::optional<double> Ground::height_m(const glm::dvec2& place_m) const {
  std::optional<double> lowest;
  if (!grid_) return lowest;
  for (const uint32_t t : (*cells_)[grid_->cell_at({place_m, 0})])
    if (const auto z = height_at(triangles_[t], place_m); z && (!lowest || *z < *lowest)) lowest = z;
  return lowest;
}

}  // namespace wavetracer
