// SPDX-License-Identifier: Apache-2.0
// Horvitz and Thompson's estimate (J. Am. Stat. Assoc. 47, 1952): a path that was found with a chance p stands for 1 /
// p paths, itself included. The number of quarters of the launch that found a path tells its chance. Frames of a drive
// see nearly the same, so their counts make a mean frame, and not a larger sample.
#include "wavetracer/missed.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "radio/path_power.hpp"

namespace wavetracer {
namespace {

// The number of missed paths for each path that k + 1 of four quarters found: a quarter finds such a path with p = (k +
// 1) / 4, and all of them miss it with (1 - p)^4.
constexpr std::array<double, 4> missed_each = {81.0 / 175, 1.0 / 15, 1.0 / 255, 0};

// A. Chao's lower bound (Biometrics 43, 1987): if f1 and f2 were found by one and by two of four quarters, at least 3/8
// f1^2 / f2 are missed, and exactly that many where all have the same chance. It holds for many; for few, chances are
// spread over decades.
constexpr double chao = 3.0 / 8, many = 5;

// These were measured, see docs/method.md: rays are even and sequences differ in size, so the truth is within a factor
// of the estimate and of its deviation by chance.
constexpr double deviations = 1.96, path_factor = 3, power_factor = 5;
constexpr double unseen = 3;  // this many may be missed where nothing was seen: the rule of three

// The factor of missed_each: 1 for few; for many, f1 says as much as in Chao's bound.
double likeness(double f1, double f2) { return (chao * f1 / missed_each[0] + many) / (f2 + many); }

MissedRange missed_paths(const std::array<double, 4>& found) {
  const double f1 = found[0], f2 = found[1];
  double estimate = 0, variance = 0;
  for (size_t k = 0; k < found.size(); ++k) {
    estimate += missed_each[k] * found[k];
    variance += missed_each[k] * missed_each[k] * found[k];
  }
  const double few = std::max(f1 - deviations * std::sqrt(f1), 0.0);
  return {.estimate = likeness(f1, f2) * estimate,
          .low = std::floor(chao * few * few / (f2 + deviations * std::sqrt(f2) + 1)),
          .high = path_factor * likeness(f1, f2) * (estimate + deviations * std::sqrt(variance)) + unseen};
}

// Rows are counted in parts of this many, whose sums do not depend on the number of cores.
constexpr size_t rows_of_part = 4096;

MissedCounts counts_of_rows(const Paths& paths, size_t first, size_t end) {
  MissedCounts out;
  out.frames = 1;
  for (size_t row = first; row < end; ++row) {
    const double power = power_of(paths, row);
    out.power += power;
    if (paths.depth[row] == 0) continue;
    const auto k = static_cast<size_t>(std::max(std::popcount(paths.quarters[row]), 1) - 1);
    ++out.paths[k];
    out.powers[k] += power;
    out.amplitude += std::sqrt(power);
  }
  return out;
}

}  // namespace

void add_part(MissedCounts& sum, const MissedCounts& more) {
  if (sum.unknown + more.unknown > 0) {
    sum = {.unknown = 1};
    return;
  }
  const uint64_t frames = std::max(sum.frames, more.frames);
  add(sum, more);
  sum.frames = frames;
}

void add(MissedCounts& sum, const MissedCounts& more) {
  sum.frames += more.frames;
  sum.unknown += more.unknown;
  for (size_t k = 0; k < sum.paths.size(); ++k) {
    sum.paths[k] += more.paths[k];
    sum.powers[k] += more.powers[k];
  }
  sum.amplitude += more.amplitude;
  sum.power += more.power;
}

MissedCounts missed_counts(const Paths& paths, size_t first, size_t end) {
  if (paths.quarters.size() != paths.size()) return {};
  std::vector<MissedCounts> parts((end - first) / rows_of_part + 1);
  tbb::parallel_for(size_t{0}, parts.size(), [&](size_t i) {
    const size_t begin = first + i * rows_of_part;
    parts[i] = counts_of_rows(paths, begin, std::min(begin + rows_of_part, end));
  });
  MissedCounts out;
  for (const MissedCounts& part : parts) add_part(out, part);
  return out;
}

Missed estimate_missed(const MissedCounts& counts) {
  Missed out;
  if (counts.frames == 0) return out;
  const auto frames = static_cast<double>(counts.frames);
  std::array<double, 4> mean{};
  double found = 0, power = 0;
  for (size_t k = 0; k < mean.size(); ++k) {
    const auto paths = static_cast<double>(counts.paths[k]);
    mean[k] = paths / frames;
    found += paths;
    power += missed_each[k] * counts.powers[k];
  }
  out.paths = missed_paths(mean);
  for (double* const value : {&out.paths.estimate, &out.paths.low, &out.paths.high}) *value *= frames;
  if (!(counts.power > 0) || found == 0) return out;
  const double amplitude = counts.amplitude / found;
  MissedRange& share = out.power_share;
  share.estimate = likeness(mean[0], mean[1]) * power / counts.power;
  if (out.paths.low > 0) share.low = share.estimate * std::min(out.paths.low / out.paths.estimate, 1.0) / power_factor;
  share.high = power_factor * share.estimate + unseen * frames * amplitude * amplitude / counts.power;
  return out;
}

}  // namespace wavetracer
