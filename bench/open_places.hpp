// SPDX-License-Identifier: Apache-2.0
// Draws places for antennas at random: in the open, or within a box.
// The same seed gives the same places everywhere: the generator is that of the standard, and distributions are not
// used.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "simulation/surroundings.hpp"

namespace wavetracer::bench {

// A rectangle on the ground, file coordinates.
struct Area {
  glm::dvec2 lower_m{0}, upper_m{0};
};

// Returns the middle of the rectangle with `share` of its sides.
Area middle_of(const Area& area, double share);
// Returns the area up to reach_m from a place in each direction.
Area around(const glm::dvec3& place_m, double reach_m);

class OpenPlaces {
 public:
  // The scene must outlive this object.
  OpenPlaces(const Scene& scene, uint64_t seed);
  // Returns the area of the whole scene.
  Area area() const;
  glm::dvec3 lower_m() const { return scene_.lower + scene_.origin_m; }
  glm::dvec3 upper_m() const { return scene_.upper + scene_.origin_m; }
  // Returns a place height_m above ground with nothing above it, in file coordinates, to a millimetre. Throws
  // InputError if hardly any place is open.
  glm::dvec3 open(const Area& area, double height_m);
  // Returns a place in a box, in the same way.
  glm::dvec3 within(const glm::dvec3& lower_m, const glm::dvec3& upper_m);
  // Returns another place distance_m from this one at its height, with nothing between them: a vehicle that ends here
  // may have come from there. It returns this place itself if all ways are obstructed.
  glm::dvec3 free_start(const glm::dvec3& end_m, double distance_m) const;

 private:
  double between(double low, double high);

  const Scene& scene_;
  Surroundings surroundings_;
  std::mt19937_64 generator_;
};

}  // namespace wavetracer::bench
