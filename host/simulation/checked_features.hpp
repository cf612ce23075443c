// SPDX-License-Identifier: Apache-2.0
// The features of a run that choose its kernels; they are checked on its device.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer {

// Ways with kernels of their own, which few runs have. Each is checked in a frame of its own, whose other features are
// always the same: reflections at tiles, the same with edges, targets and bodies with reflections, the same with edges,
// rays from edges, and vegetation.
enum class CheckedWays : uint32_t { none, tiles, tile_edges, targets, target_edges, heard_edges, vegetation };
constexpr uint32_t checked_ways = 6;  // without none

// Reflection is always one of them. Frames that reuse sequences, ray caches and discovery by beams have kernels of
// their own, but the same paths.
struct CheckedFeatures {
  bool instances = false, transmission = false, scattering = false;
  uint32_t diffractions = 0;  // most of a path: 0, 1, 2, or 3 for three and more
  bool reuse = false;
  bool beams = false;
  bool ordered = false;    // rays are sorted
  bool sums = false;       // the device sums the paths of links
  CacheConfig cache = {};  // kind "none": no cache
  CheckedWays ways = CheckedWays::none;

  // The features of the frame in which these ways are checked.
  static CheckedFeatures of(CheckedWays ways);
  // Names them in words: "reflection, diffraction at two edges, vehicles".
  std::string words() const;
  // The number of the known frame that has the paths of these features, see known_frames.hpp.
  uint32_t frame() const {
    if (ways != CheckedWays::none) return 31 + static_cast<uint32_t>(ways);
    return diffractions + 4 * (uint32_t{instances} + 2 * uint32_t{transmission} + 4 * uint32_t{scattering});
  }
};

// Sets of features that run every kernel that is checked: `wavetracer devices --check` checks a device for each.
std::vector<CheckedFeatures> all_checked_features();

}  // namespace wavetracer
