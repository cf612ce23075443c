// SPDX-License-Identifier: Apache-2.0
// Converts degrees and heights above the ground into file coordinates. Latitudes and longitudes are within their
// ranges, since the configuration was checked.
#include "simulation/place_finder.hpp"

#include <fmt/format.h>

#include "wavetracer/error.hpp"

namespace wavetracer {

bool PlaceFinder::has_georeference() const {
  return !config_.scene.file.empty() && !georeference_file(config_.scene.file).empty();
}

glm::dvec2 PlaceFinder::from_degrees(const glm::dvec2& longitude_latitude, const std::string& what) {
  if (!projection_ && has_georeference())
    if (const auto reference = find_georeference(config_.scene.file); reference && !reference->projection.empty())
      projection_.emplace(*reference);
  if (!projection_)
    throw ConfigError(
        fmt::format("{}: a position in degrees needs a georeference.json with the projection of the scene beside its "
                    "file{}; `wavetracer convert MAP -o FOLDER` writes one, and docs/formats.md has its form",
                    what, config_.scene.file.empty() ? ", which a generated city does not have" : ""));
  return projection_->scene(longitude_latitude);
}

std::shared_ptr<const Ground> PlaceFinder::ground() {
  if (!ground_) ground_ = std::make_shared<const Ground>(scene_);
  return ground_;
}

std::array<double, 3> PlaceFinder::position_m(const RadioEnd& end) {
  std::array<double, 3> out = end.position_m;
  if (end.position_wgs84) {
    const auto& [latitude, longitude, height_m] = *end.position_wgs84;
    const glm::dvec2 place_m = from_degrees({longitude, latitude}, fmt::format("\"{}\"", end.name));
    out = {place_m.x, place_m.y, height_m};
  } else if (!from_ground(end.above)) {
    return out;
  }
  const std::optional<double> below_m = ground_m({out[0], out[1]});
  if (!below_m)
    throw ConfigError(
        fmt::format("\"{}\": its height is above the ground, but there is no ground at ({:.1f}, {:.1f}) m in the "
                    "scene: is this the right place?",
                    end.name, out[0], out[1]));
  out[2] += *below_m;
  return out;
}

}  // namespace wavetracer
