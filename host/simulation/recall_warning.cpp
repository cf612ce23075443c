// SPDX-License-Identifier: Apache-2.0
// The launch knows the share of sequences that were met once; the frame knows which quarters of the launch found its
// paths. If the launch warns, the frame may show that nothing is lost.
#include "simulation/recall_warning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wavetracer {

namespace {

// Did the frame find the asked share of the paths, as far as its rays show? They never show that it found all.
bool reached(double recall, const MissedCounts& counts) {
  const auto found = static_cast<double>(std::accumulate(counts.paths.begin(), counts.paths.end(), uint64_t{0}));
  return recall < 1 && counts.frames > 0 && found >= recall * (found + estimate_missed(counts).paths.estimate);
}

// If fewer rays than this met anything, and a smaller share than this, no ray may have met large parts of the scene: a
// city of 87 houses, seen from 20 km, lost half of its paths where 40 of 200,000 rays met it.
constexpr uint64_t few_hits = 1000;
constexpr double few_share = 0.02;

// A house fits between rays that are this far apart. A town of 64 houses on a plain of 100 km, seen from 1 to 40 km,
// lost 12 to 20 of its 18 to 22 paths where rays were 57 to 2500 m apart, and "probably none" was said of most.
constexpr double most_apart_m = 30;

// The largest of 1, 2, 3 or 5 times a power of ten that is not above the value. So neighbouring frames say the same.
double rounded_down(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  return (value < 2 * power ? 1 : value < 3 * power ? 2 : value < 5 * power ? 3 : 5) * power;
}

}  // namespace

std::optional<std::string> recall_warning(const DiscoveryCounts& found, const TraceConfig& trace, bool cold,
                                          const MissedCounts& missed) {
  const bool capped = found.end == LaunchEnd::max_rays;
  if (found.end == LaunchEnd::recall || !(capped || cold)) return {};
  if (!capped && reached(trace.recall, missed)) return {};
  const std::string once = found.share_once < 0.005 ? "less than 1" : fmt::format("{:.0f}", 100 * found.share_once);
  const std::string before = fmt::format(
      "before it reached trace.recall = {}: {}% of the sequences found were met by only one ray", trace.recall, once);
  if (capped) return fmt::format("trace.max_rays = {} ended the launch of rays = \"auto\" {}", trace.max_rays, before);
  const char* const why = found.end == LaunchEnd::finest ? "its rays cannot come closer to each other"
                                                         : "the rays beside them met nothing rare";
  return fmt::format("the launch of rays = \"auto\" ended {}, and {}; give trace.rays a number to find more", before,
                     why);
}

std::optional<std::string> few_met_warning(const DiscoveryCounts& found, bool surfaces) {
  if (!surfaces || found.rays == 0 || found.hits >= few_hits) return {};
  if (static_cast<double>(found.hits) >= few_share * static_cast<double>(found.rays)) return {};
  return fmt::format(
      "less than {:g}% of the rays met anything, and fewer than {}, so it is not known how many paths they missed: "
      "give trace.rays a higher number, or leave away what makes the scene large and empty; trace.discovery = "
      "\"beams\" misses none",
      100 * few_share, few_hits);
}

std::optional<std::string> far_apart_warning(const DiscoveryCounts& found, double rays_each) {
  const double apart_m = std::sqrt(found.spread_m2 / std::max(rays_each, 1.0));
  if (found.rays == 0 || apart_m < most_apart_m) return {};
  const double enough = found.spread_m2 / (most_apart_m * most_apart_m);
  return fmt::format(
      "rays are {:g} m and more apart where a receiver is, so houses there may lie between them, and it is not known "
      "how many paths they missed: give trace.rays a number above {:.0e}; trace.discovery = \"beams\" misses none",
      rounded_down(apart_m), enough);
}

std::optional<std::string> RayWitness::hear(const DiscoveryCounts& found, bool cold, bool surfaces) {
  if (cold) *this = {};
  if (found.rays == 0) return {};
  rays_each_ += found.rays_each;
  std::optional<std::string> text = few_met_warning(found, surfaces);
  if (!text && surfaces) text = far_apart_warning(found, rays_each_);
  tells_ = !text;
  return text;
}

}  // namespace wavetracer
