// Projections of maps, by PROJ.
// Assumes that a map without a footprint needs none.
#include "imports/projecting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr double widest_map_deg = 2;  // 200 km: a slip, or a country, of which no scene can be made

// A transverse Mercator projection about the middle of the buildings: true to scale and angle, north is +y.
Georeference local_projection(Map& map, const std::string& name, const std::string& advice) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  glm::dvec2 lower(infinity), upper(-infinity);
  each_point(map, [&](const glm::dvec2& p) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
  });
  if (upper.x - lower.x > widest_map_deg || upper.y - lower.y > widest_map_deg) {
    throw InputError(fmt::format("{}: spans {:.1f} by {:.1f} degrees; extract a city from it: {}", name,
                                 upper.x - lower.x, upper.y - lower.y, advice));
  }
  return {fmt::format("+proj=tmerc +lat_0={:.6f} +lon_0={:.6f} +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs",
                      (lower.y + upper.y) / 2, (lower.x + upper.x) / 2),
          {0, 0},
          {},
          {}};
}

void take_network(Map& map, const std::filesystem::path& file) {
  const auto location = sumo_location(read_file(file), file.string());
  if (!location || location->georeference.projection.empty()) {
    throw InputError(
        fmt::format("{}: has no <location> with a projection; give the .net.xml that netconvert made of "
                    "the same map",
                    file.string()));
  }
  map.georeference = location->georeference;
  map.network = location->boundary;
}

}  // namespace

void project(Map& map, const std::string& name, const ImportOptions& options, const std::string& advice) {
  if (map.footprints.empty()) return;
  if (!options.net.empty()) {
    take_network(map, options.net);
  } else if (!options.projection.empty()) {
    map.georeference = {options.projection, {0, 0}, {}, {}};
  } else {
    map.georeference = local_projection(map, name, advice);
  }
  const Projection projection(map.georeference);
  each_point(map, [&](glm::dvec2& p) { p = projection.scene(p); });
}

}  // namespace wavetracer::imports
