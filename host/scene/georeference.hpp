// Where a scene is on the earth: georeference.json beside the scene file, written by the imports, read by whoever has
// or wants degrees. Projection by PROJ, no database needed for PROJ strings.
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
  std::string attribution;    // who must be named where the data is shown
  // The height of z = 0 above sea level, m; not given: z is the height above flat ground.
  std::optional<double> elevation_m = {};
};

// Longitude and latitude in degrees (WGS84) from the scene's file coordinates and back.
class Projection {
 public:
  explicit Projection(const Georeference& reference);  // throws InputError where PROJ does not know the string
  ~Projection();
  Projection(Projection&&) noexcept;
  glm::dvec2 geographic(const glm::dvec2& scene_m) const;  // (longitude, latitude)
  glm::dvec2 scene(const glm::dvec2& longitude_latitude) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The georeference.json in the folder of a scene file; empty where there is none.
std::filesystem::path georeference_file(const std::filesystem::path& scene_file);

void write_georeference(const std::filesystem::path& file, const Georeference& reference);
// Of the folder of a scene file; empty where there is none. Throws InputError where it is malformed.
std::optional<Georeference> find_georeference(const std::filesystem::path& scene_file);

}  // namespace wavetracer
