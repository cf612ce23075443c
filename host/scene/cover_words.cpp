// SPDX-License-Identifier: Apache-2.0
#include "scene/cover_words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace wavetracer {

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
