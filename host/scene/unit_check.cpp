// SPDX-License-Identifier: Apache-2.0
// Mountains are as high as houses in millimetres, but few of their triangles are upright, and none of those is a
// kilometre high.
#include "scene/unit_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace wavetracer {
namespace {

constexpr double highest_wall_m = 1000;    // no building is so high
constexpr double highest_scene_m = 10000;  // no difference of heights of mountains and valleys is so large
constexpr double upright = 0.17;  // largest vertical part of the unit normal of an upright triangle (within 10 degrees)
constexpr double most_upright = 0.2;  // largest upright share of a mountain's area

struct Upright {
  double lowest_m = std::numeric_limits<double>::infinity(), highest_m = -lowest_m;
  double area_m2 = 0, upright_m2 = 0, wall_m = 0;  // wall_m: height of the highest upright triangle
};

}  // namespace

std::string unit_warning(const Scene& scene) {
  if (scene.upper.z - scene.lower.z <= highest_wall_m) return "";
  std::vector<Upright> objects(scene.objects.size());
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    const auto& [i, j, k] = scene.triangles[t];
    const glm::dvec3 &a = scene.vertices[i], &b = scene.vertices[j], &c = scene.vertices[k];
    const glm::dvec3 twice = glm::cross(b - a, c - a);
    const auto [low, high] = std::minmax({a.z, b.z, c.z});
    const double area = glm::length(twice);
    Upright& object = objects[scene.triangle_object[t]];
    object.lowest_m = std::min(object.lowest_m, low);
    object.highest_m = std::max(object.highest_m, high);
    object.area_m2 += area;
    if (std::abs(twice.z) > upright * area) continue;
    object.upright_m2 += area;
    object.wall_m = std::max(object.wall_m, high - low);
  }
  const auto height = [](const Upright& object) { return object.highest_m - object.lowest_m; };
  const auto too_high = [&](const Upright& object) {
    return object.wall_m > highest_wall_m ||
           (height(object) > highest_wall_m && object.upright_m2 > most_upright * object.area_m2);
  };
  constexpr const char* what_to_do =
      "is scene.scale right? It is in metres per unit of the file: 0.001 for a file in millimetres, "
      "0.01 for centimetres";
  if (const auto found = std::ranges::find_if(objects, too_high); found != objects.end())
    return fmt::format("\"{}\" has walls and is {:.0f} m high: {}",
                       scene.objects[static_cast<size_t>(found - objects.begin())], height(*found), what_to_do);
  if (scene.upper.z - scene.lower.z > highest_scene_m)
    return fmt::format("the scene is {:.0f} m high: {}", scene.upper.z - scene.lower.z, what_to_do);
  return "";
}

}  // namespace wavetracer
