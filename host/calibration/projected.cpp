// SPDX-License-Identifier: Apache-2.0
#include "calibration/projected.hpp"
#include <fmt/format.h>
#include <functional>
#include <glm/vec2.hpp>
#include "imports/source_system.hpp"
#include "scene/georeference.hpp"

namespace wavetracer::calibration {
namespace {

// Replaces east and north by latitude and longitude.
void convert(MeasuredFile& file, const std::function<glm::dvec2(const glm::dvec2&)>& geographic) {
  for (MeasuredPoint& point : file.points) {
    const glm::dvec2 degrees = geographic({point.position[0], point.position[1]});
    point.position[0] = degrees.y;
    point.position[1] = degrees.x;
  }
  file.degrees = true;
}

glm::dvec2 middle_of(const MeasuredFile& file) {
  glm::dvec2 sum(0);
  for (const MeasuredPoint& point : file.points) sum += glm::dvec2(point.position[0], point.position[1]);
  return sum / static_cast<double>(file.points.size());
}

}  // namespace

void places_to_degrees(MeasuredFile& file, const std::string& crs) {
  if (crs.starts_with("+proj=")) {
    const Projection projection({.projection = crs, .offset_m = {0, 0}, .attribution = ""});
    return convert(file, [&](const glm::dvec2& place_m) { return projection.geographic(place_m); });
  }
  imports::SourceSystem system(crs, file.file + ", --crs");
  system.choose_order(middle_of(file), 0);
  if (system.swapped())
    file.notes.push_back(
        fmt::format("{}: only with x as north and y as east the places are in the area of {}, so they are read so",
                    file.file, crs));
  convert(file, [&](const glm::dvec2& place) { return system.geographic(place); });
}

}  // namespace wavetracer::calibration
