// SPDX-License-Identifier: Apache-2.0
#include "calibration/spread_agreement.hpp"
#include <fmt/format.h>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include "calibration/fit_data.hpp"
#include "calibration/spread_kinds.hpp"
#include "output/median.hpp"

namespace wavetracer::calibration {
namespace {

SpreadStatistics statistics_of_kind(const Calibration& result, const SpreadKind& kind, Computed FittedPoint::*which) {
  std::vector<SpreadPair> pairs;
  for (const FittedPoint& point : result.points)
    if (const auto measured = result.files[point.file].points[point.point].*kind.measured)
      pairs.push_back({*measured, point.*which.*kind.computed});
  return spread_statistics(pairs);
}

std::vector<double> bin_differences(const Calibration& result, Computed FittedPoint::*which) {
  std::vector<double> out;
  for (const FittedPoint& point : result.points)
    for (const auto& [bin, level] : measured_bins(result.files[point.file].points[point.point], result.profile_bin_ns))
      if (const double computed = shape_db(point.*which, {0, spread_kinds.size(), bin}); std::isfinite(computed))
        out.push_back(level - computed);
  return out;
}

}  // namespace

SpreadStatistics spread_statistics(std::span<const SpreadPair> pairs) {
  std::vector<double> measured, computed, ratio;
  for (const SpreadPair& pair : pairs)
    if (std::isfinite(pair.computed)) {
      measured.push_back(pair.measured);
      computed.push_back(pair.computed);
      ratio.push_back(pair.computed / pair.measured);
    }
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  if (ratio.empty()) return {0, undefined, undefined, undefined};
  return {ratio.size(), median(measured), median(computed), median(ratio)};
}

study::NumberTable spread_table(const Calibration& result) {
  study::NumberTable table{.caption =
                               "Spreads: medians over the points where both are known, and the median of "
                               "computed divided by measured",
                           .heads = {"spread", "", "points", "measured", "computed", "ratio"},
                           .rows = {}};
  for (const SpreadKind& kind : spread_kinds)
    for (const auto& [what, which] :
         {std::pair{"as configured", &FittedPoint::before}, {"fitted", &FittedPoint::after}}) {
      const SpreadStatistics of = statistics_of_kind(result, kind, which);
      if (of.points == 0) continue;
      table.rows.push_back({kind.name, what, std::to_string(of.points), fmt::format("{:.3g}", of.measured),
                            fmt::format("{:.3g}", of.computed), fmt::format("{:.2f}", of.ratio)});
    }
  return table;
}

study::NumberTable profile_table(const Calibration& result) {
  study::NumberTable table{
      .caption = fmt::format("Profiles of delays in bins of {:g} ns: measured minus computed levels, each in dB of the "
                             "power of its link",
                             result.profile_bin_ns),
      .heads = {fmt::format("profiles of {:g} ns", result.profile_bin_ns), "bins", "median, dB", "rms, dB"},
      .rows = {}};
  for (const auto& [what, which] : {std::pair{"as configured", &FittedPoint::before},
                                    {"fitted", &FittedPoint::after},
                                    {"held out", &FittedPoint::held_out}}) {
    const std::vector<double> differences = bin_differences(result, which);
    if (differences.empty()) continue;
    double squares = 0;
    for (const double difference : differences) squares += difference * difference;
    table.rows.push_back({what, std::to_string(differences.size()), fmt::format("{:.2f}", median(differences)),
                          fmt::format("{:.2f}", std::sqrt(squares / static_cast<double>(differences.size())))});
  }
  return table;
}

}  // namespace wavetracer::calibration
