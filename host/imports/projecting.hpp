// From degrees to the coordinates of the scene, for maps that come in longitude and latitude.
#pragma once
#include <string>

#include "imports/map.hpp"

namespace wavetracer::imports {

constexpr double metres_per_degree = 111320;  // of latitude; no less than of longitude

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

// The projection of the scene, in the order of project(), of a map that covers these degrees; sets `network` where
// there is one.
Georeference scene_projection(const Extent& degrees, const std::string& name, const ImportOptions& options,
                              const std::string& advice, Extent& network);

// Footprints in degrees (longitude, latitude) into coordinates of the network of options.net, or of
// options.projection, or else of a transverse Mercator projection about their middle; sets the map's georeference.
// advice: how to cut a part out of a map that is too wide. Throws InputError.
void project(Map& map, const std::string& name, const ImportOptions& options, const std::string& advice);

}  // namespace wavetracer::imports
