// The features of a run that choose its kernels: a device is checked for them.
#pragma once
#include <cstdint>
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer {

// Reflection is always one of them. Frames that reuse sequences and ray caches have kernels of their own, and the same
// paths.
struct CheckedFeatures {
  bool instances = false, transmission = false, scattering = false;
  uint32_t diffractions = 0;  // of a path: 0, 1, 2, or 3 for as many as there may be
  bool reuse = false;
  CacheConfig cache = {};  // of kind "none": no cache

  // "reflection, diffraction at two edges, vehicles".
  std::string words() const;
  // Which of the known frames has the paths of these features, see known_frames.hpp.
  uint32_t frame() const {
    return diffractions + 4 * (uint32_t{instances} + 2 * uint32_t{transmission} + 4 * uint32_t{scattering});
  }
};

}  // namespace wavetracer
