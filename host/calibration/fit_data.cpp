// SPDX-License-Identifier: Apache-2.0
#include "calibration/fit_data.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "calibration/spread_kinds.hpp"

namespace wavetracer::calibration {
namespace {

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
    out.spreads.push_back({i, kind});
  }
  if (count > 0 && !fits && !request.patterns.empty())
    out.notes.push_back(fmt::format("{} measured {} spreads are compared and not fitted; --spreads {} fits them", count,
                                    of.word, of.word));
}

}  // namespace

double spread_db(double spread) { return 10 * std::log10(spread); }

FitData fit_data(const Request& request, const Calibration& result) {
  FitData out;
  add_levels(out, request, result);
  for (size_t kind = 0; kind < spread_kinds.size(); ++kind) add_spreads(out, request, result, kind);
  return out;
}

}  // namespace wavetracer::calibration
