// SPDX-License-Identifier: Apache-2.0
// Converts maps with longitude and latitude in degrees to the coordinates of the scene.
#pragma once
#include <string>

#include "imports/map.hpp"

namespace wavetracer::imports {

constexpr double metres_per_degree = 111320;  // metres per degree of latitude; a degree of longitude is no longer

// Calls visit(glm::dvec2&) for every point of every ring.
template <class Visit>
void each_point(Map& map, const Visit& visit) {
  for (Footprint& footprint : map.footprints) {
    for (glm::dvec2& p : footprint.outer) visit(p);
    for (RingM& hole : footprint.holes) {
      for (glm::dvec2& p : hole) visit(p);
    }
  }
}

// Returns the projection of the scene for a map that covers these degrees; the sources are tried in the order of
// project(). Sets `network` if there is one.
Georeference scene_projection(const Extent& degrees, const std::string& name, const ImportOptions& options,
                              const std::string& advice, Extent& network);

// Converts footprints in degrees (longitude, latitude) to coordinates of the network of options.net, or of
// options.projection, or else of a transverse Mercator projection about their middle; sets the map's georeference.
// advice: how to cut a part out of a map that is too wide, for the error. Throws InputError.
void project(Map& map, const std::string& name, const ImportOptions& options, const std::string& advice);

}  // namespace wavetracer::imports
