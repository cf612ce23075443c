// Makes the warnings about places that surfaces of two materials share in one plane.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// An area in square metres, in three digits or all those before the point.
std::string area_words(double area_m2);

class SharedPlaces {
 public:
  // Adds a place of so many square metres. equally_large: both surfaces are, so that their materials' names decide.
  void add(uint32_t cover_material, uint32_t covered_material, bool equally_large, double area_m2);
  // A sentence for each pair of materials, those that share most first; of more than a few pairs the rest are counted.
  std::vector<std::string> warnings(const Scene& scene) const;

 private:
  std::map<std::tuple<uint32_t, uint32_t, bool>, double> area_m2_;
};

}  // namespace wavetracer
