// Places for antennas, drawn at random: in the open, or within a box.
// The same seed gives the same places everywhere: the generator is the standard's own, distributions are not used.
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

// The middle of the rectangle, `share` of its sides.
Area middle_of(const Area& area, double share);
// Up to reach_m from a place to each side.
Area around(const glm::dvec3& place_m, double reach_m);

class OpenPlaces {
 public:
  // The scene must outlive this.
  OpenPlaces(const Scene& scene, uint64_t seed);
  // Of the whole scene.
  Area area() const;
  glm::dvec3 lower_m() const { return scene_.lower + scene_.origin_m; }
  glm::dvec3 upper_m() const { return scene_.upper + scene_.origin_m; }
  // A place height_m above ground that nothing covers, in file coordinates, to a millimetre. Throws InputError where
  // hardly any place is open.
  glm::dvec3 open(const Area& area, double height_m);
  // A place in a box, likewise.
  glm::dvec3 within(const glm::dvec3& lower_m, const glm::dvec3& upper_m);
  // Another place distance_m from this one on its level, with nothing between them: where something that ends here may
  // have come from. This place itself where all ways are obstructed.
  glm::dvec3 free_start(const glm::dvec3& end_m, double distance_m) const;

 private:
  double between(double low, double high);

  const Scene& scene_;
  Surroundings surroundings_;
  std::mt19937_64 generator_;
};

}  // namespace wavetracer::bench
