// SPDX-License-Identifier: Apache-2.0
// Writes a map as KML 2.2 with Google's extension gx (https://developers.google.com/kml/documentation/kmlreference):
// pictures of layers, laid on the ground by the longitudes and latitudes of the map's corners.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include "coverage/coverage_map.hpp"
#include "coverage/png.hpp"
#include "scene/georeference.hpp"

namespace wavetracer::coverage {

// A layer on the ground: its picture, a file beside the document, and the values of the darkest and brightest colour.
struct Overlay {
  const LayerKind* layer = nullptr;
  ColourRange range = {};
  std::string picture;
};

// Returns the georeference, without which there is no KML. scene_file: the file beside which it would be; empty if it
// is not known. Throws InputError if it is not there.
const Georeference& georeference_for_kml(const std::optional<Georeference>& georeference,
                                         const std::string& scene_file);

// Returns longitudes and latitudes in degrees (WGS84) of the map's corners: south-west, south-east, north-east and
// north-west, as programs want them. Beyond the meridian of 180 degrees longitudes go on above 180 or below -180.
// Throws InputError if a corner is not on the earth.
std::array<glm::dvec2, 4> corners_of(const Map& map, const Georeference& georeference);

// Returns the document. Overlays would hide each other, so all but the first are hidden until somebody turns them on.
std::string kml(const Map& map, const Georeference& georeference, std::span<const Overlay> overlays);

}  // namespace wavetracer::coverage
