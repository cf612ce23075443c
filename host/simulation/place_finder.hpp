// SPDX-License-Identifier: Apache-2.0
// Places that the configuration gives in degrees, by the scene's georeference, or as heights above its ground. Both are
// only made when they are needed.
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

  // Is there a georeference.json beside the scene file? It is read when a place needs it.
  bool has_georeference() const;
  // Converts (longitude, latitude) in degrees into file coordinates. what: the thing that is placed, for messages.
  // Throws ConfigError if there is no georeference, InputError if it is malformed.
  glm::dvec2 from_degrees(const glm::dvec2& longitude_latitude, const std::string& what);
  // Returns the z of the ground at a place, both in file coordinates; empty if there is none.
  std::optional<double> ground_m(const glm::dvec2& place_m) { return ground()->height_m(place_m); }
  std::shared_ptr<const Ground> ground();
  // Returns position_m of an end whose position may be given in any way. Throws ConfigError if there is no ground below
  // it.
  std::array<double, 3> position_m(const RadioEnd& end);

 private:
  const Config& config_;
  const Scene& scene_;
  std::optional<Projection> projection_;
  std::shared_ptr<const Ground> ground_;
};

}  // namespace wavetracer
