// Places that the configuration gives by the earth or by the ground: degrees by the scene's georeference, heights above
// its ground. What is not asked for is not made.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

#include "scene/georeference.hpp"
#include "scene/ground.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

class PlaceFinder {
 public:
  // Both must outlive this.
  PlaceFinder(const Config& config, const Scene& scene) : config_(config), scene_(scene) {}

  // Whether a georeference.json is beside the scene file; it is read when a place needs it.
  bool has_georeference() const;
  // (longitude, latitude) in degrees in file coordinates. what: what is placed, for messages. Throws ConfigError where
  // there is no georeference, InputError where it is malformed.
  glm::dvec2 from_degrees(const glm::dvec2& longitude_latitude, const std::string& what);
  // The z of the ground at a place, both in file coordinates; empty where there is none.
  std::optional<double> ground_m(const glm::dvec2& place_m) { return ground()->height_m(place_m); }
  std::shared_ptr<const Ground> ground();
  // position_m of an end whose position is given in any way. Throws ConfigError where there is no ground below it.
  std::array<double, 3> position_m(const RadioEnd& end);

 private:
  const Config& config_;
  const Scene& scene_;
  std::optional<Projection> projection_;
  std::shared_ptr<const Ground> ground_;
};

}  // namespace wavetracer
