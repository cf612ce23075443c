// SPDX-License-Identifier: Apache-2.0
// The place of a map for programs that show it: the north-western corner and the coordinate system.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>
#include "coverage/coverage_map.hpp"
#include "scene/georeference.hpp"

namespace wavetracer::coverage {

// The parameters of a projection that GeoTIFF names.
struct NamedProjection {
  uint32_t epsg = 0;  // code of a projected system of EPSG; 0: a transverse Mercator projection with the next numbers
  double latitude_deg = 0, longitude_deg = 0, scale = 1, false_east_m = 0, false_north_m = 0;
};

// Returns what GeoTIFF needs for a PROJ string on WGS84: +proj=utm and +proj=tmerc. Throws InputError for others.
NamedProjection named_projection(const std::string& proj);

// Coordinates are those of the projection, or, without a georeference, those of the scene file.
struct MapPlace {
  double west_m = 0, north_m = 0;  // the corner
  glm::dvec2 step_m{0};            // width and height of a cell
  std::optional<Georeference> georeference;
};

MapPlace place_of(const Map& map, const std::optional<Georeference>& georeference);

}  // namespace wavetracer::coverage
