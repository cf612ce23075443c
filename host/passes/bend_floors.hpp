// SPDX-License-Identifier: Apache-2.0
// The powers below which paths over edges are left out, in the terms of kernels/lib/bend_bound.clh.
#pragma once
#include <cmath>
#include <numbers>
#include <optional>

namespace wavetracer {

// The gain that paths over one edge and over two need, without the factors that all of them have: the amplitude of a
// wave at 1 m, a wavelength for each edge, and the largest jump at a boundary. 0: no path is left out.
struct BendFloors {
  double one = 0, two = 0;
};

// The wavelengths in bounds of waves over one edge.
struct BentWaves {
  double wavelength_m = 0;  // the longest one
  double wave_m = 0;        // that times the square of the largest jump at a boundary
};

// passes: see bend_floors.
inline BentWaves bent_waves(double wavelength_m, bool passes) {
  return {wavelength_m, wavelength_m * (passes ? 4 : 1)};
}

// floor_db: the gain between isotropic antennas below which a path may be left out; wavelength_m: the longest; passes:
// surfaces pass waves, so the jump at a boundary may be twice the wave.
inline BendFloors bend_floors(std::optional<double> floor_db, double wavelength_m, bool passes) {
  if (!floor_db) return {};
  constexpr double rounding = 1e-6;
  const double at_1_m = wavelength_m / (4 * std::numbers::pi), edge = bent_waves(wavelength_m, passes).wave_m;
  const double one = std::pow(10.0, *floor_db / 10) * (1 - rounding) / (at_1_m * at_1_m * edge);
  return {one, one / edge};
}

}  // namespace wavetracer
