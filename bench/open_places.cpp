// SPDX-License-Identifier: Apache-2.0
// A place is open if a line straight down hits nothing but the ground.
// Kerbs, cars and uneven ground below one metre count as ground; roofs and decks are higher.
#include "open_places.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double ground_tolerance_m = 1;
constexpr int most_tries = 10'000;  // open places are at least a hundredth of a dense city

double to_millimetres(double metres) { return std::round(metres * 1e3) / 1e3; }

}  // namespace

Area middle_of(const Area& area, double share) {
  const dvec2 middle = 0.5 * (area.lower_m + area.upper_m), half = 0.5 * share * (area.upper_m - area.lower_m);
  return {middle - half, middle + half};
}

Area around(const dvec3& place_m, double reach_m) {
  const dvec2 middle(place_m.x, place_m.y);
  return {middle - reach_m, middle + reach_m};
}

OpenPlaces::OpenPlaces(const Scene& scene, uint64_t seed) : scene_(scene), surroundings_(scene), generator_(seed) {}

Area OpenPlaces::area() const { return {{lower_m().x, lower_m().y}, {upper_m().x, upper_m().y}}; }

double OpenPlaces::between(double low, double high) {
  return low + static_cast<double>(generator_() >> 11) * 0x1p-53 * (high - low);
}

dvec3 OpenPlaces::open(const Area& area, double height_m) {
  for (int tries = 0; tries < most_tries; ++tries) {
    const double x = to_millimetres(between(area.lower_m.x, area.upper_m.x));
    const double y = to_millimetres(between(area.lower_m.y, area.upper_m.y));
    const dvec3 above = dvec3(x, y, upper_m().z + 1) - scene_.origin_m, below(above.x, above.y, scene_.lower.z - 1);
    const auto crossings = surroundings_.crossings(above, below);
    if (crossings.empty() || crossings.back().distance_m - crossings.front().distance_m > ground_tolerance_m) continue;
    const double ground = upper_m().z + 1 - crossings.back().distance_m;
    return {x, y, to_millimetres(ground + height_m)};
  }
  throw InputError(
      fmt::format("{}: of {} places between ({}, {}) and ({}, {}) none is open to the sky; "
                  "is this a scene with streets?",
                  scene_.file, most_tries, area.lower_m.x, area.lower_m.y, area.upper_m.x, area.upper_m.y));
}

dvec3 OpenPlaces::within(const dvec3& lower_m, const dvec3& upper_m) {
  dvec3 place;
  for (int axis = 0; axis < 3; ++axis) place[axis] = to_millimetres(between(lower_m[axis], upper_m[axis]));
  return place;
}

dvec3 OpenPlaces::free_start(const dvec3& end_m, double distance_m) const {
  // Rotations by 3-4-5 triangles are the same on every machine and never return to the start.
  dvec2 way(1, 0);
  for (int turn = 0; turn < 16; ++turn, way = dvec2(0.6 * way.x - 0.8 * way.y, 0.8 * way.x + 0.6 * way.y)) {
    const dvec3 start = end_m + distance_m * dvec3(way.x, way.y, 0), beyond = end_m + 1.1 * (start - end_m);
    if (surroundings_.crossings(end_m - scene_.origin_m, beyond - scene_.origin_m).empty()) return start;
  }
  return end_m;
}

}  // namespace wavetracer::bench
