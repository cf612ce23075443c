// SPDX-License-Identifier: Apache-2.0
// The features in words, in the order of a path.
#include "simulation/checked_features.hpp"

namespace wavetracer {

std::string CheckedFeatures::words() const {
  std::string out = "reflection";
  constexpr const char* edges[] = {"", ", diffraction", ", diffraction at two edges", ", diffraction at many edges"};
  out += edges[diffractions];
  if (transmission) out += ", transmission";
  if (scattering) out += ", scattering";
  if (instances) out += ", vehicles";
  if (reuse) out += ", frames that follow each other";
  if (beams) out += ", beams";
  if (cache.on()) out += ", a ray cache (" + cache.kind.text() + ")";
  return out;
}

}  // namespace wavetracer
