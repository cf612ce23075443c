// SPDX-License-Identifier: Apache-2.0
// The place of a scene on the Earth: georeference.json beside the scene file. The imports write it, and commands that
// read or print degrees use it. PROJ projects; PROJ strings need no database.
#pragma once
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

namespace wavetracer {

struct Georeference {
  std::string projection;     // PROJ string, such as "+proj=tmerc +lat_0=48.1 +lon_0=11.5 +ellps=WGS84 +units=m"
  glm::dvec2 offset_m{0, 0};  // scene file coordinate = projected coordinate + offset_m (SUMO's netOffset)
  std::string attribution;    // text that must be shown with the data
  // The height of z = 0 above sea level, m; if it is not given, z is the height above flat ground.
  std::optional<double> elevation_m = {};
};

// Converts longitude and latitude in degrees (WGS84) from and to the scene's file coordinates.
class Projection {
 public:
  explicit Projection(const Georeference& reference);  // throws InputError if PROJ does not know the string
  ~Projection();
  Projection(Projection&&) noexcept;
  glm::dvec2 geographic(const glm::dvec2& scene_m) const;  // (longitude, latitude)
  glm::dvec2 scene(const glm::dvec2& longitude_latitude) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns the path of georeference.json in the folder of a scene file, or an empty path if it does not exist.
std::filesystem::path georeference_file(const std::filesystem::path& scene_file);

void write_georeference(const std::filesystem::path& file, const Georeference& reference);
// Reads georeference.json in the folder of a scene file; returns nothing if it does not exist. Throws InputError if it
// is malformed.
std::optional<Georeference> find_georeference(const std::filesystem::path& scene_file);

}  // namespace wavetracer
