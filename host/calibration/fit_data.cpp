// SPDX-License-Identifier: Apache-2.0
#include "calibration/fit_data.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include "calibration/delay_profile.hpp"
#include "calibration/spread_kinds.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

// The logarithm of a spread in its unit, dB.
double spread_db(double spread) { return 10 * std::log10(spread); }

constexpr size_t most_profile_bins = 10'000;

const MeasuredPoint& measured_of(const Calibration& result, const FittedPoint& point) {
  return result.files[point.file].points[point.point];
}

// Returns the number of an offset, which is added if it is new.
size_t offset_number(FitData& out, const std::string& name) {
  const auto found = std::ranges::find(out.offset_names, name);
  if (found != out.offset_names.end()) return static_cast<size_t>(found - out.offset_names.begin());
  out.offset_names.push_back(name);
  return out.offset_names.size() - 1;
}

void add_levels(FitData& out, const Request& request, const Calibration& result) {
  for (const FittedPoint& point : result.points) {
    const MeasuredPoint& measured = measured_of(result, point);
    Datum datum{.value = measured.level_db, .below = measured.below};
    if (request.offsets == "all") datum.offset = offset_number(out, "all points");
    if (request.offsets == "file") datum.offset = offset_number(out, result.files[point.file].file);
    if (request.offsets == "tx") datum.offset = offset_number(out, point.tx);
    out.data.push_back(datum);
  }
}

void add_spreads(FitData& out, const Request& request, const Calibration& result, size_t kind) {
  const SpreadKind& of = spread_kinds[kind];
  const bool fits = request.spreads == "all" || request.spreads.word() == of.word;
  size_t count = 0;
  for (size_t i = 0; i < result.points.size(); ++i) {
    const std::optional<double> spread = measured_of(result, result.points[i]).*of.measured;
    if (!spread) continue;
    ++count;
    if (!fits) continue;
    out.data.push_back({.value = spread_db(*spread), .kind = 1 + kind});
    out.shapes.push_back({i, kind});
  }
  if (count > 0 && !fits && !request.patterns.empty())
    out.notes.push_back(fmt::format("{} measured {} spreads are compared and not fitted; --spreads {} fits them", count,
                                    of.word, of.word));
}

void add_profiles(FitData& out, const Request& request, const Calibration& result) {
  constexpr size_t kind = spread_kinds.size();
  for (size_t i = 0; i < result.points.size(); ++i)
    for (const auto& [bin, level] : measured_bins(measured_of(result, result.points[i]), request.profile_bin_ns)) {
      out.data.push_back({.value = level, .kind = 1 + kind});
      out.shapes.push_back({i, kind, bin});
    }
  if (request.profile_bin_ns > 0 && (out.shapes.empty() || out.shapes.back().kind != kind))
    throw InputError("--profiles needs components with a delay, but no measured file has a column delay_ns");
}

}  // namespace

double shape_db(const Computed& computed, const ShapeDatum& datum) {
  if (datum.kind < spread_kinds.size()) return spread_db(computed.*spread_kinds[datum.kind].computed);
  return datum.bin < computed.profile.size() ? computed.profile[datum.bin] : std::numeric_limits<double>::quiet_NaN();
}

size_t most_bins(const std::vector<MeasuredFile>& files, double bin_ns) {
  size_t out = 0;
  for (const MeasuredFile& file : files)
    for (const MeasuredPoint& point : file.points)
      if (bin_ns > 0 && !point.components.empty())
        out = std::max(out, bins_of(point.components, 1e-9 * bin_ns, most_profile_bins));
  return out;
}

std::vector<std::pair<size_t, double>> measured_bins(const MeasuredPoint& point, double bin_ns) {
  std::vector<std::pair<size_t, double>> out;
  if (!(bin_ns > 0) || point.components.empty()) return out;
  const size_t bins = bins_of(point.components, 1e-9 * bin_ns, most_profile_bins);
  const std::vector<double> levels = delay_profile(point.components, 1e-9 * bin_ns, bins);
  for (size_t bin = 0; bin < levels.size(); ++bin)
    if (levels[bin] >= -profile_range_db) out.emplace_back(bin, levels[bin]);
  return out;
}

size_t kinds_of_data() { return 2 + spread_kinds.size(); }

FitData fit_data(const Request& request, const Calibration& result) {
  FitData out;
  add_levels(out, request, result);
  for (size_t kind = 0; kind < spread_kinds.size(); ++kind) add_spreads(out, request, result, kind);
  add_profiles(out, request, result);
  return out;
}

}  // namespace wavetracer::calibration
