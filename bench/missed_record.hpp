// SPDX-License-Identifier: Apache-2.0
// Counts over many cases how often a launch kept its promise, and how often `missed` contained the truth.
// Shares of zero cases are 1.
#pragma once
#include <cstddef>
#include <cstdint>

#include "wavetracer/missed.hpp"

namespace wavetracer::bench {

struct LostInTruth {
  double paths = 0;
  double path_share = 0;   // share of all paths
  double power_share = 0;  // share of the power that was found
};

class MissedRecord {
 public:
  // kept: the launch found the requested share of paths.
  void add(bool kept, uint64_t segments, double seconds, const LostInTruth& truth, const Missed& said);

  size_t cases() const { return cases_; }
  size_t kept() const { return kept_; }
  size_t losing() const { return losing_; }  // number of cases that lost anything
  double kept_share() const { return share(kept_, cases_); }
  double mean_path_share() const { return cases_ > 0 ? path_shares_ / static_cast<double>(cases_) : 0; }
  double paths_held() const { return share(paths_held_, cases_); }
  double power_held() const { return share(power_held_, cases_); }
  // Share of these cases in which the estimate of the power is within a factor of three of the truth.
  double power_near() const { return share(power_near_, losing_); }
  uint64_t segments() const { return segments_; }  // sums over cases
  double seconds() const { return seconds_; }

 private:
  static double share(size_t part, size_t of) {
    return of > 0 ? static_cast<double>(part) / static_cast<double>(of) : 1;
  }

  size_t cases_ = 0, kept_ = 0, losing_ = 0, paths_held_ = 0, power_held_ = 0, power_near_ = 0;
  uint64_t segments_ = 0;
  double seconds_ = 0, path_shares_ = 0;
};

}  // namespace wavetracer::bench
