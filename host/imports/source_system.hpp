// The coordinate system that a city model names, and the way from its coordinates to longitude and latitude, by PROJ
// and its database. Files do not agree on which axis comes first, so what they contain decides.
#pragma once
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <string_view>

namespace wavetracer::imports {

// "EPSG:7415" of "https://www.opengis.net/def/crs/EPSG/0/7415", "urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783"
// and other spellings, of several codes the first, which is the horizontal one; of "urn:adv:crs:ETRS89_UTM32*..." that
// of the surveyors of German states. Empty where there is none.
std::string system_code(std::string_view text);

class SourceSystem {
 public:
  // text: as in the file called `name`. Throws InputError where it is not known, or no system of places on the earth;
  // RuntimeError where PROJ has no database.
  SourceSystem(const std::string& text, const std::string& name);
  ~SourceSystem();

  // Decides whether the first coordinate is the one that the system names first, from a point in the middle of the
  // model: it has to be in the area of the system, and roofs have to look up. roofs_up: of the coordinates as they are
  // in the file, positive where most roofs look up, 0 where that is not known. Throws InputError where the model is
  // not in that area either way.
  void choose_order(const glm::dvec2& middle, double roofs_up);
  bool swapped() const;  // whether it is against the order that the name stands for

  glm::dvec2 geographic(const glm::dvec2& file) const;  // (longitude, latitude), WGS84
  double metres_per_height() const;
  bool above_ellipsoid() const;  // heights are above the ellipsoid, not above the sea

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer::imports
