// SPDX-License-Identifier: Apache-2.0
// Projects maps by PROJ.
#include "imports/projecting.hpp"

#include <fmt/format.h>

#include "base/file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr double widest_map_deg = 2;  // 200 km: either a mistake, or a country, which is too large for a scene

// Returns a transverse Mercator projection about the middle of the buildings: true to scale and angle, with north at
// +y.
Georeference local_projection(const Extent& degrees, const std::string& name, const std::string& advice) {
  const glm::dvec2 &lower = degrees.lower_m, &upper = degrees.upper_m;
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

Georeference take_network(const std::filesystem::path& file, Extent& network) {
  const auto location = sumo_location(read_file(file), file.string());
  if (!location || location->georeference.projection.empty()) {
    throw InputError(
        fmt::format("{}: has no <location> with a projection; give the .net.xml that netconvert made of "
                    "the same map",
                    file.string()));
  }
  network = location->boundary;
  return location->georeference;
}

}  // namespace

Georeference scene_projection(const Extent& degrees, const std::string& name, const ImportOptions& options,
                              const std::string& advice, Extent& network) {
  if (!options.net.empty()) return take_network(options.net, network);
  if (!options.projection.empty()) return {options.projection, {0, 0}, {}, {}};
  return local_projection(degrees, name, advice);
}

void project(Map& map, const std::string& name, const ImportOptions& options, const std::string& advice) {
  if (map.footprints.empty()) return;
  Extent degrees;
  each_point(map, [&](const glm::dvec2& p) { degrees.add(p); });
  map.georeference = scene_projection(degrees, name, options, advice, map.network);
  const Projection projection(map.georeference);
  each_point(map, [&](glm::dvec2& p) { p = projection.scene(p); });
}

}  // namespace wavetracer::imports
