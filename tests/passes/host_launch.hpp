// SPDX-License-Identifier: Apache-2.0
// The rays of a launch computed on the host, for comparison with devices, which use the same header.
#pragma once
#include <cstdint>

#include "wavetracer/config.hpp"
#include "wavetracer/device/directions.h"

namespace wavetracer::test {

// The numbers that the maps take: the step or the seed, and the cells of hilbert: the fewest faces and levels that hold
// n rays. They are computed here again, and not by LaunchDirections, which is under test.
struct HostLaunch {
  Directions map;
  uint64_t parameter;
  unsigned level = 0, faces = 3;

  HostLaunch(Directions of, uint64_t n, uint64_t seed) : map(of), parameter(at_random(of) ? seed : ~uint64_t{0} / n) {
    while ((uint64_t{12} << (2 * level)) < n) ++level;
    while ((uint64_t{faces} << (2 * level)) < n) ++faces;
  }

  // The place of ray i on the cylinder, in units of 2^-32.
  struct Place {
    uint32_t height, turn;
  };
  Place place(uint64_t i) const {
    const auto function = map == "fibonacci" ? device::wt_place_fibonacci
                          : map == "random"  ? device::wt_place_random
                                             : device::wt_place_hilbert;
    Place out{};
    function(i, parameter, level, faces, &out.height, &out.turn);
    return out;
  }
  // heights: tables, of which "horizon" uses the one that begins at number `table`; other maps use none.
  device::wt_direction direction(uint64_t i, const float* heights = nullptr, uint32_t table = 0) const {
    const auto [height, turn] = place(i);
    return device::wt_spread(height, turn, map == "horizon", heights, table);
  }
};

}  // namespace wavetracer::test
