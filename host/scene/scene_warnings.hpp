// SPDX-License-Identifier: Apache-2.0
// Makes warnings about a scene: of sizes that no scene in metres has, and of areas where surfaces of two materials
// share one plane.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns a warning that names the object and its height and says what to do; empty if the sizes are possible.
std::string unit_warning(const Scene& scene);

// Returns an area in square metres as text, with three digits or more if there are more before the point.
std::string area_words(double area_m2);

class SharedPlaces {
 public:
  // Adds an area where one material covers another. equally_large: both surfaces have the same area, so that the names
  // of their materials decide.
  void add(uint32_t cover_material, uint32_t covered_material, bool equally_large, double area_m2);
  // Returns a sentence for each pair of materials, those that share the largest area first; after a few pairs the rest
  // is only counted.
  std::vector<std::string> warnings(const Scene& scene) const;

 private:
  std::map<std::tuple<uint32_t, uint32_t, bool>, double> area_m2_;
};

}  // namespace wavetracer
