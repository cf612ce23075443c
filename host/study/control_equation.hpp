// SPDX-License-Identifier: Apache-2.0
// The control equation of S. Popov et al., as the thesis quotes it (2.3): |A(e)| |A(l)| = C_E^2 / (P(e) P(l) N). Two
// clusters, of areas A and probability densities P, share a visibility query; N is the number of paths, and C_E bounds
// the error. Here one end of a segment is the primitive that it left, which the key always tells apart, and the other
// is a cell of directions of solid angle A, met by rays with P = 1 / (4 pi): C_E^2 = N A / (4 pi), the mean number of
// rays that a launch of N has in a cell.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace wavetracer::study {

// Number of cells of directions that the unit sphere passes through, if a component is cut into `division` cells: cubes
// of side h meet a surface in 3/2 of its area over h^2, on average over its directions.
inline double direction_cells(double division) { return 1.5 * std::numbers::pi * division * division; }

inline double control_error(double rays, double division) { return std::sqrt(rays / direction_cells(division)); }

// Returns the division for this C_E, at least 1.
inline uint32_t control_division(uint64_t rays, double error) {
  const double division = std::sqrt(static_cast<double>(rays) / (1.5 * std::numbers::pi)) / error;
  return static_cast<uint32_t>(std::max(1.0, std::round(division)));
}

}  // namespace wavetracer::study
