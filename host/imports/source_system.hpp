// SPDX-License-Identifier: Apache-2.0
// The coordinate system that a city model names, and the conversion of its coordinates to longitude and latitude, by
// PROJ and its database. Files do not agree on which axis comes first, so their content decides.
#pragma once
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <string_view>

namespace wavetracer::imports {

// Returns "EPSG:7415" for "https://www.opengis.net/def/crs/EPSG/0/7415",
// "urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783" and other spellings; if there are several codes, it takes the
// first, which is the horizontal one. For "urn:adv:crs:ETRS89_UTM32*..." it returns that of the surveyors of German
// states. It is empty if there is no code.
std::string system_code(std::string_view text);

class SourceSystem {
 public:
  // text: the text in the file called `name`. Throws InputError if the system is unknown or not one of places on the
  // Earth; RuntimeError if PROJ has no database.
  SourceSystem(const std::string& text, const std::string& name);
  ~SourceSystem();

  // Decides whether the first coordinate is the one that the system names first, from a point in the middle of the
  // model: the point must be in the area of the system, and roofs must look up. roofs_up: for the coordinates of the
  // file, positive if most roofs look up, 0 if that is unknown. Throws InputError if the model is outside of that area
  // with either order.
  void choose_order(const glm::dvec2& middle, double roofs_up);
  bool swapped() const;  // tells whether the order is the opposite of the system's own

  glm::dvec2 geographic(const glm::dvec2& file) const;  // (longitude, latitude), WGS84
  double metres_per_height() const;
  bool above_ellipsoid() const;  // true if heights are above the ellipsoid, not above the sea

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::imports
