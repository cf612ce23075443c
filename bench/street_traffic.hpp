// SPDX-License-Identifier: Apache-2.0
// Makes traffic for scenes without a road map: vehicles that drive straight along free strips of the ground.
// Streets are at about z = 0 of the file's coordinates, as in munich and in the generated city.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::bench {

struct StreetTraffic {
  size_t vehicles = 100;
  double duration_s = 2;   // all vehicles are present from 0 s on
  glm::dvec3 centre_m{0};  // centre of the disc in which drives begin; file coordinates
  double radius_m = 300;
  std::vector<glm::dvec3> standing_m = {};  // places that vehicles avoid like other vehicles; file coordinates
  uint64_t seed = 1;
};

// Returns tracks "car0", "car1", ... of the types passenger (85 %), delivery (8 %) and truck (7 %), at 5 to 14 m/s.
// Each begins where nothing is above the ground within 2.5 m, its strip of 3 m is free of everything above the kerb
// from 4 m behind its first place to 4 m beyond its last, and 6 m are left at any time between the circles around any
// two vehicles. The same arguments give the same tracks everywhere, to a millimetre. Throws InputError where they do
// not fit.
std::vector<TrackConfig> street_traffic(const Scene& scene, const StreetTraffic& traffic);

// Returns places from which a vehicle without a size can drive straight to `end_m` over free ground, length_m long, in
// up to `most` directions spread over the circle; file coordinates, at the height of the end. Throws InputError if
// there is none.
std::vector<glm::dvec3> free_ways_to(const Scene& scene, glm::dvec3 end_m, double length_m, size_t most);

}  // namespace wavetracer::bench
