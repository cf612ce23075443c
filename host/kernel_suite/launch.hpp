// SPDX-License-Identifier: Apache-2.0
// The launches of GenerateRays and LaunchKeys: their map and their number of rays, as passes take them.
#pragma once
#include <fmt/format.h>

#include "kernel_suite/state.hpp"
#include "passes/launch_directions.hpp"
#include "wavetracer/kernels/generate_rays.hpp"

namespace wavetracer::kernels {

inline Directions pass_directions(const char* pass, LaunchMap map) {
  switch (map) {
    case LaunchMap::hilbert:
      return "hilbert";
    case LaunchMap::horizon:
      return "horizon";
    case LaunchMap::fibonacci:
      return "fibonacci";
    case LaunchMap::random:
      return "random";
  }
  refuse(pass, "there is no such map");
}

// Throws Error for a number of rays that no launch has, and for a map that is none.
inline LaunchDirections directions_of(const char* pass, LaunchMap map, uint64_t rays, uint64_t seed) {
  constexpr uint64_t most = uint64_t{1} << 31;
  if (rays < 1 || rays > most) refuse(pass, fmt::format("a launch of {} rays: it has 1 to {}", rays, most));
  return LaunchDirections(pass_directions(pass, map), rays, seed);
}

// Throws Error if rays first .. first + n - 1 are not all in a launch.
inline void check_launched(const char* pass, uint64_t first, size_t n, uint64_t launched) {
  if (first > launched || n > launched - first)
    refuse(pass, fmt::format("rays {} to {} of a launch of {}", first, first + n, launched));
}

}  // namespace wavetracer::kernels
