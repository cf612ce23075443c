// SPDX-License-Identifier: Apache-2.0
// Counts over many cases how often a launch kept its promise, and how often `missed` contained the truth.
// Shares of zero cases are 1.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "wavetracer/missed.hpp"

namespace wavetracer::bench {

struct LostInTruth {
  double paths = 0;
  double path_share = 0;   // share of all paths
  double power_share = 0;  // share of the power that was found
};

class MissedRecord {
 public:
  // kept: the launch found the requested share of paths. said: nothing if the launch does not know what it missed.
  void add(bool kept, uint64_t segments, double seconds, const LostInTruth& truth, const std::optional<Missed>& said);

  size_t cases() const { return cases_; }
  size_t kept() const { return kept_; }
  size_t losing() const { return losing_; }          // number of cases that lost anything, and said how much
  size_t unknown() const { return cases_ - told_; }  // number of cases that did not say what they missed
  double kept_share() const { return share(kept_, cases_); }
  double mean_path_share() const { return cases_ > 0 ? path_shares_ / static_cast<double>(cases_) : 0; }
  double paths_held() const { return share(paths_held_, told_); }
  double power_held() const { return share(power_held_, told_); }
  // Share of these cases in which the estimate of the power is within a factor of three of the truth.
  double power_near() const { return share(power_near_, losing_); }
  uint64_t segments() const { return segments_; }  // sums over cases
  double seconds() const { return seconds_; }

 private:
  static double share(size_t part, size_t of) {
    return of > 0 ? static_cast<double>(part) / static_cast<double>(of) : 1;
  }

  size_t cases_ = 0, told_ = 0, kept_ = 0, losing_ = 0, paths_held_ = 0, power_held_ = 0, power_near_ = 0;
  uint64_t segments_ = 0;
  double seconds_ = 0, path_shares_ = 0;
};

// The estimate of the number, and that of the power, with their intervals.
std::string words_of(const Missed& missed);
// The record in a sentence. recall: what the launches were asked for.
std::string words_of(const MissedRecord& record, double recall);

}  // namespace wavetracer::bench
