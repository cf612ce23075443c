// A. Chao's lower bound (Biometrics 1987, for four occasions) and what was measured against it on 17 scenes.
// Frames of a drive see nearly the same, so their counts make a mean frame, and not a larger sample.
#include "wavetracer/missed.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>

#include "wavetracer/paths.hpp"

namespace wavetracer {
namespace {

// With f1 and f2 paths found by one and by two quarters of a random launch, (3/4) f1^2 / (2 f2) are missed at least.
// Rays of a launch are even, and sequences differ in size: the truth was near the estimate in the mean for directions =
// "horizon", and twice as much for "hilbert".
constexpr double chao = 0.375, measured = 0.5, most = 1.5;
constexpr double unseen = 3;  // as many may be missed where nothing was seen: the rule of three
constexpr double deviations = 1.96;
// The missed are as strong as the rare ones in the mean, within this factor in nine cases of ten.
constexpr double power_factor = 5;

MissedRange missed_paths(double f1, double f2) {
  const double few = std::max(f1 - deviations * std::sqrt(f1), 0.0), many = f1 + deviations * std::sqrt(f1);
  return {.estimate = measured * f1 * f1 / (f2 + 1),
          .low = std::floor(chao * few * few / (f2 + deviations * std::sqrt(f2) + 1)),
          .high = std::max(unseen, most * many * many / (f2 + 1))};
}

double power_of(const Paths& paths, size_t row) {
  double power = 0;
  for (const auto& a : paths.a[row]) power += std::norm(a);
  return power;
}

}  // namespace

void add_part(MissedCounts& sum, const MissedCounts& more) {
  for (size_t k = 0; k < sum.paths.size(); ++k) sum.paths[k] += more.paths[k];
  sum.rare_power += more.rare_power;
  sum.found_power += more.found_power;
  sum.power += more.power;
  sum.frames = std::max(sum.frames, more.frames);
}

void add(MissedCounts& sum, const MissedCounts& more) {
  const uint64_t frames = sum.frames + more.frames;
  add_part(sum, more);
  sum.frames = frames;
}

MissedCounts missed_counts(const Paths& paths, size_t first, size_t end) {
  MissedCounts out;
  if (paths.quarters.size() != paths.size()) return out;
  out.frames = 1;
  for (size_t row = first; row < end; ++row) {
    const double power = power_of(paths, row);
    const int quarters = std::popcount(paths.quarters[row]);
    out.power += power;
    if (paths.depth[row] == 0) continue;
    ++out.paths[static_cast<size_t>(std::max(quarters, 1) - 1)];
    out.found_power += power;
    if (quarters <= 2) out.rare_power += power;
  }
  return out;
}

Missed estimate_missed(const MissedCounts& counts) {
  Missed out;
  if (counts.frames == 0) return out;
  const auto frames = static_cast<double>(counts.frames);
  const auto met = [&](size_t k) { return static_cast<double>(counts.paths[k]); };
  out.paths = missed_paths(met(0) / frames, met(1) / frames);
  for (double* const value : {&out.paths.estimate, &out.paths.low, &out.paths.high}) *value *= frames;
  const double rare = met(0) + met(1), found = rare + met(2) + met(3);
  if (!(counts.power > 0) || found == 0) return out;
  const double mean = rare > 0 ? counts.rare_power / rare : counts.found_power / found;
  const double share = mean / counts.power;
  out.power_share = {.estimate = out.paths.estimate * share,
                     .low = out.paths.low * share / power_factor,
                     .high = out.paths.high * share * power_factor};
  return out;
}

}  // namespace wavetracer
