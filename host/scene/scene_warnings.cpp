// SPDX-License-Identifier: Apache-2.0
// Mountains are as high as houses in millimetres, but few of their triangles are upright, and none of those is a
// kilometre high.
#include "scene/scene_warnings.hpp"

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

std::string area_words(double area_m2) {
  return area_m2 < 100 ? fmt::format("{:.3g} m2", area_m2) : fmt::format("{:.0f} m2", area_m2);
}

void SharedPlaces::add(uint32_t cover_material, uint32_t covered_material, bool equally_large, double area_m2) {
  area_m2_[{cover_material, covered_material, equally_large}] += area_m2;
}

std::vector<std::string> SharedPlaces::warnings(const Scene& scene) const {
  constexpr size_t most = 4;
  struct Line {
    double area_m2;
    std::string cover, covered;
    bool equally_large;
  };
  std::vector<Line> lines;
  for (const auto& [key, area_m2] : area_m2_) {
    const auto& [cover, covered, equally_large] = key;
    lines.push_back({area_m2, scene.materials[cover].name, scene.materials[covered].name, equally_large});
  }
  std::ranges::sort(lines, [](const Line& a, const Line& b) {
    return a.area_m2 != b.area_m2 ? a.area_m2 > b.area_m2 : std::tie(a.cover, a.covered) < std::tie(b.cover, b.covered);
  });
  std::vector<std::string> out;
  for (size_t i = 0; i < std::min(lines.size(), most); ++i) {
    const auto& [area_m2, cover, covered, equally_large] = lines[i];
    out.push_back(
        fmt::format("surfaces of {0} and {1} lie on each other in one plane, on {2}: {0} counts there, "
                    "because {3}. If {1} is meant, leave out the {0} there, or draw one of them at least 1 cm "
                    "in front of the other",
                    cover, covered, area_words(area_m2),
                    equally_large ? "both surfaces are equally large and its name comes first in the alphabet"
                                  : "its surface is the smaller one, as a road drawn on the ground"));
  }
  if (lines.size() > most)
    out.push_back(
        fmt::format("surfaces of {} more pairs of materials lie on each other in one plane; the smaller one counts",
                    lines.size() - most));
  return out;
}

}  // namespace wavetracer
