// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <cmath>
#include "base/csv_columns.hpp"
#include "calibration/report.hpp"

namespace wavetracer::calibration {
namespace {

constexpr double hardly_told = 0.5, far_from_prior = 2, strong_correlation = 0.9;

std::string decibels(double value) { return std::isfinite(value) ? fmt::format("{:.2f}", value) : "-"; }

std::string with_unit(double value, Property property) {
  const std::string unit = unit_of(property);
  return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
}

double fitted_value(const Calibration& result, size_t p) { return result.parameters[p].value(result.fit.theta[p]); }
double fitted_error(const Calibration& result, size_t p) {
  return result.parameters[p].error(result.fit.theta[p], result.fit.errors[p]);
}

std::string name_of_number(const Calibration& result, size_t i) {
  const size_t count = result.parameters.size();
  return i < count ? result.parameters[i].name() : "the offset of " + result.offset_names[i - count];
}

std::vector<std::string> cells_of(const Statistics& of) {
  return {std::to_string(of.with_a_path), decibels(of.offset_db), decibels(of.sigma_db),
          std::isfinite(of.spearman) ? fmt::format("{:.3f}", of.spearman) : "-"};
}

}  // namespace

study::NumberTable parameter_table(const Calibration& result) {
  study::NumberTable table{.caption =
                               "Parameters: values of the configuration, fitted values with standard errors, and "
                               "the share of the prior variance that the data remove",
                           .heads = {"parameter", "before", "fitted", "standard error", "told by the data"},
                           .rows = {}};
  for (size_t p = 0; p < result.parameters.size(); ++p) {
    const Property property = result.parameters[p].property;
    table.rows.push_back({result.parameters[p].name(), with_unit(result.parameters[p].start, property),
                          with_unit(fitted_value(result, p), property), with_unit(fitted_error(result, p), property),
                          fmt::format("{:.0f}%", 100 * result.fit.told[p])});
  }
  for (size_t k = 0; k < result.offset_names.size(); ++k)
    table.rows.push_back({"offset of " + result.offset_names[k], "-", fmt::format("{:.2f} dB", result.fit.offsets[k]),
                          fmt::format("{:.2f} dB", result.fit.errors[result.parameters.size() + k]), "-"});
  return table;
}

study::NumberTable agreement_table(const Calibration& result) {
  study::NumberTable table{
      .caption =
          "Measured minus computed level: mean (offset) and standard deviation (sigma) in dB, and Spearman's "
          "rank correlation. Offsets that were fitted are in the computed levels",
      .heads = {"points", "", "with a path", "offset", "sigma", "rank"},
      .rows = {}};
  const auto add = [&](const std::string& name, const char* what, const Statistics& of) {
    std::vector<std::string> cells{name, what};
    for (std::string& cell : cells_of(of)) cells.push_back(std::move(cell));
    table.rows.push_back(std::move(cells));
  };
  for (const Agreement& agreement : result.agreements) {
    add(fmt::format("{} ({})", agreement.name, agreement.before.points), "as configured", agreement.before);
    add("", "fitted", agreement.after);
    if (agreement.held_out.points > 0) add("", "held out", agreement.held_out);
  }
  return table;
}

std::vector<std::string> findings(const Calibration& result) {
  std::vector<std::string> out = result.notes;
  const FitResult& fit = result.fit;
  for (size_t p = 0; p < result.parameters.size(); ++p) {
    const double moved = std::abs(fit.theta[p]) / result.parameters[p].prior;
    if (moved > far_from_prior)
      out.push_back(fmt::format(
          "the data move {} by {:.1f} standard deviations of its prior: look at the residuals, since it may "
          "make up for something that the map lacks",
          result.parameters[p].name(), moved));
    else if (fit.told[p] > 0 && fit.told[p] < hardly_told)
      out.push_back(fmt::format("the data hardly tell {}: its value is mostly that of the configuration",
                                result.parameters[p].name()));
  }
  const size_t size = fit.errors.size();
  for (size_t i = 0; i < size; ++i)
    for (size_t j = i + 1; j < size; ++j)
      if (const double r = fit.correlation[i * size + j]; std::abs(r) > strong_correlation)
        out.push_back(fmt::format("{} and {} are known together only: the correlation of their errors is {:.2f}",
                                  name_of_number(result, i), name_of_number(result, j), r));
  return out;
}

std::string points_csv(const Calibration& result) {
  Csv table({"file", "line", "tx", "group", "x_m", "y_m", "z_m", "block", "measured_db", "below", "before_db",
             "fitted_db", "held_out_db", "measured_spread_ns", "before_spread_ns", "fitted_spread_ns",
             "measured_azimuth_spread_deg", "before_azimuth_spread_deg", "fitted_azimuth_spread_deg"});
  const bool held_out = !result.agreements.empty() && result.agreements.front().held_out.points > 0;
  for (const FittedPoint& point : result.points) {
    const MeasuredFile& file = result.files[point.file];
    const MeasuredPoint& measured = file.points[point.point];
    table.add(file.file, measured.line, point.tx, measured.group, point.place_m.x, point.place_m.y, point.place_m.z,
              point.fold, measured.level_db, measured.below, point.before.gain_db,
              point.after.gain_db + point.offset_db,
              held_out ? point.held_out.gain_db + point.offset_held_out_db : std::nan(""),
              measured.delay_spread_ns.value_or(std::nan("")), point.before.delay_spread_ns,
              point.after.delay_spread_ns, measured.azimuth_spread_deg.value_or(std::nan("")),
              point.before.azimuth_spread_deg, point.after.azimuth_spread_deg);
  }
  return table.text();
}

std::string parameters_csv(const Calibration& result) {
  Csv table({"parameter", "unit", "before", "fitted", "standard_error", "told_share"});
  for (size_t p = 0; p < result.parameters.size(); ++p)
    table.add(result.parameters[p].name(), unit_of(result.parameters[p].property), result.parameters[p].start,
              fitted_value(result, p), fitted_error(result, p), result.fit.told[p]);
  for (size_t k = 0; k < result.offset_names.size(); ++k)
    table.add("offset of " + result.offset_names[k], "dB", 0.0, result.fit.offsets[k],
              result.fit.errors[result.parameters.size() + k], 1.0);
  return table.text();
}

}  // namespace wavetracer::calibration
