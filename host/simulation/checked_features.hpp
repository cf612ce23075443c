// SPDX-License-Identifier: Apache-2.0
// The features of a run that choose its kernels; they are checked on its device.
#pragma once
#include <cstdint>
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer {

// Reflection is always one of them. Frames that reuse sequences, ray caches and discovery by beams have kernels of
// their own, but the same paths.
struct CheckedFeatures {
  bool instances = false, transmission = false, scattering = false;
  uint32_t diffractions = 0;  // most of a path: 0, 1, 2, or 3 for three and more
  bool reuse = false;
  bool beams = false;
  CacheConfig cache = {};  // kind "none": no cache

  // Names them in words: "reflection, diffraction at two edges, vehicles".
  std::string words() const;
  // The number of the known frame that has the paths of these features, see known_frames.hpp.
  uint32_t frame() const {
    return diffractions + 4 * (uint32_t{instances} + 2 * uint32_t{transmission} + 4 * uint32_t{scattering});
  }
};

}  // namespace wavetracer
