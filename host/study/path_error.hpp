// SPDX-License-Identifier: Apache-2.0
// Compares the paths of a frame with those of a reference frame of the same world: lost and spurious ones. Paths are
// paired by transmitter, receiver and what they touch, in order: surfaces and edges, of the scene or of which vehicle,
// and the kind of interaction. Both frames must have the same ports.
#pragma once
#include <array>
#include <cstdint>
#include "study/statistics.hpp"
#include "wavetracer/paths.hpp"

namespace wavetracer::study {

// Shares are relative to the reference frame. They are NaN if it is empty, or nothing was paired.
struct PathError {
  uint64_t reference_paths = 0, paired = 0;
  uint64_t lost = 0, spurious = 0;  // paths that only the reference has, and that only the other frame has
  double lost_share = undefined, spurious_share = undefined;
  double lost_power = undefined, spurious_power = undefined;  // share of the sum of |a|^2 of all paths and ports
  // For links that have paths in both frames: |dB| of the sums of |a|^2, and differences of rms spreads.
  uint64_t links = 0, links_lost = 0, links_spurious = 0;
  double power_median_db = undefined, power_max_db = undefined;
  double delay_spread_ns = undefined, doppler_spread_hz = undefined;  // means over links
  double delay_ns = undefined;                                        // mean over paired paths
  // Distances of the centroids of the two clouds of path vertices, without ends: equation 6.3 of the thesis.
  double l1_m = undefined, l2_m = undefined;
  double mean_path_length_m = undefined;  // mean of the reference: errors in metres are compared with it
  double l1_relative = undefined, l2_relative = undefined;
};

PathError path_error(const Paths& reference, const Paths& paths);

// Returns 10 lg of a share of power; -infinity for 0.
double share_db(double share);

// Returns the rms spread of delays or Doppler shifts weighted by powers, in their unit.
double rms_spread(std::span<const double> values, std::span<const double> powers);

// The errors of many frames: running means (equation 6.2) over those in which they are defined, and sums of counts.
class PathErrorMean {
 public:
  void add(const PathError& error);
  // Shares of paths are computed from the sums. power_max_db is the largest of all frames; the other numbers are means.
  PathError mean() const;

 private:
  static constexpr std::array averaged = {&PathError::lost_power,
                                          &PathError::spurious_power,
                                          &PathError::power_median_db,
                                          &PathError::delay_spread_ns,
                                          &PathError::doppler_spread_hz,
                                          &PathError::delay_ns,
                                          &PathError::l1_m,
                                          &PathError::l2_m,
                                          &PathError::mean_path_length_m,
                                          &PathError::l1_relative,
                                          &PathError::l2_relative};
  PathError sums_;
  std::array<RunningMean, averaged.size()> means_;
};

}  // namespace wavetracer::study
