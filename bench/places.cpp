// SPDX-License-Identifier: Apache-2.0
// Places are drawn by street_points, so that they are the same on every machine.
// The nearest receiver comes first, so that a single link has paths.
#include "places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>

#include "scene/city.hpp"
#include "scene/load.hpp"
#include "street.hpp"

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;

// Antenna height of cars; receivers are around the corner, not out of town.
constexpr double antenna_height_m = 1.5, radius_m = 300;

std::vector<RadioEnd> ends(const char* prefix, const std::vector<glm::dvec3>& points) {
  std::vector<RadioEnd> result;
  for (const glm::dvec3& p : points)
    result.push_back({.name = fmt::format("{}{}", prefix, result.size()), .position_m = {p.x, p.y, p.z}});
  return result;
}

// Adds the receivers, then the transmitters after the first one, which stands at `first`.
void place_ends(Place& place, const glm::dvec3& first, size_t transmitters, size_t receivers) {
  Config config;
  config.scene = place.scene;
  auto points = street_points(load_scene(config), first, radius_m, antenna_height_m, receivers + transmitters - 1);
  const auto border = points.begin() + static_cast<std::ptrdiff_t>(receivers);
  std::iter_swap(points.begin(), std::min_element(points.begin(), border, [&](const auto& a, const auto& b) {
                   return glm::distance(a, first) < glm::distance(b, first);
                 }));
  std::vector<glm::dvec3> senders{first};
  senders.insert(senders.end(), border, points.end());
  place.transmitters = ends("tx", senders);
  place.receivers = ends("rx", {points.begin(), border});
}

}  // namespace

std::optional<Place> munich_place(const std::string& shared, size_t transmitters, size_t receivers) {
  const fs::path file = fs::path(shared) / "scenes" / "munich" / "munich.xml";
  if (!fs::exists(file)) return {};
  Place place;
  place.name = "munich";
  place.scene.file = file.string();
  place_ends(place, {45, 90, antenna_height_m}, transmitters, receivers);  // a street crossing, in the open
  return place;
}

Place city_place(size_t transmitters, size_t receivers) {
  Place place;
  place.name = "city";
  place.scene.generate = "--seed 1";
  const auto first = example_positions(parse_city_options(place.scene.generate)).front().position_m;
  place_ends(place, {first[0], first[1], first[2]}, transmitters, receivers);
  return place;
}

Config config_of(const Place& place, size_t transmitters, size_t receivers) {
  Config config;
  config.scene = place.scene;
  config.radio.frequency_hz = 5.9e9;
  const auto first = [](const std::vector<RadioEnd>& ends, size_t count) {
    return std::vector(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count));
  };
  config.transmitters = first(place.transmitters, transmitters);
  config.receivers = first(place.receivers, receivers);
  return config;
}

}  // namespace wavetracer::bench
