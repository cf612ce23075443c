// SPDX-License-Identifier: Apache-2.0
// Writes the rows of a study of inputs as CSV, as lines for a terminal, and as a figure.
// A number is empty if a link has none.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include "accuracy/inputs.hpp"
#include "base/csv_columns.hpp"
#include "output/median.hpp"

namespace wavetracer::accuracy {
namespace {

std::string cell(double value) { return std::isfinite(value) ? six_digits(value) : ""; }

double width(const InputInterval& interval) { return interval.high - interval.low; }

// Returns NaN for an empty list.
double median_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  return values.empty() ? std::nan("") : median(std::move(values));
}

template <class Value>
double median_over(const InputStudy& study, const Value& value) {
  std::vector<double> values;
  for (const InputRow& row : study.rows) values.push_back(value(row));
  return median_of(std::move(values));
}

void add_interval(std::vector<std::string>& cells, const InputInterval& i) {
  for (const double value : {i.nominal, i.low, i.middle, i.high}) cells.push_back(cell(value));
}

void add_share_names(std::vector<std::string>& names, const char* of) {
  for (const char* input : input_names) names.push_back(fmt::format("{}_{}_share", of, input));
  names.push_back(fmt::format("{}_explained", of));
}

void add_shares(std::vector<std::string>& cells, const std::array<double, input_count>& shares, double explained) {
  for (const double share : shares) cells.push_back(cell(share));
  cells.push_back(cell(explained));
}

std::string shares_line(const InputStudy& study, std::array<double, input_count> InputRow::*shares) {
  std::string out;
  for (size_t input = 0; input < input_count; ++input) {
    if (!study.varied[input]) continue;
    const double share = median_over(study, [&](const InputRow& row) { return (row.*shares)[input]; });
    out += fmt::format("{}{} {:.0f}%", out.empty() ? "" : ", ", input_names[input], 100 * share);
  }
  return out;
}

}  // namespace

std::string inputs_csv(const InputStudy& study) {
  std::vector<std::string> names = {
      "frame",         "tx",           "rx",          "samples",           "gain_nominal_db",
      "gain_p5_db",    "gain_p50_db",  "gain_p95_db", "spread_nominal_ns", "spread_p5_ns",
      "spread_p50_ns", "spread_p95_ns"};
  add_share_names(names, "gain");
  add_share_names(names, "spread");
  Csv table(std::move(names));
  for (const InputRow& row : study.rows) {
    std::vector<std::string> cells = {std::to_string(row.frame), row.tx, row.rx, std::to_string(row.samples)};
    add_interval(cells, row.gain_db);
    add_interval(cells, row.delay_spread_ns);
    add_shares(cells, row.gain_share, row.gain_explained);
    add_shares(cells, row.delay_spread_share, row.delay_spread_explained);
    table.add_texts(cells);
  }
  return table.text();
}

std::string inputs_text(const InputStudy& study) {
  constexpr size_t shown = 10;
  std::vector<const InputRow*> widest;
  for (const InputRow& row : study.rows)
    if (std::isfinite(width(row.gain_db))) widest.push_back(&row);
  std::stable_sort(widest.begin(), widest.end(),
                   [](const InputRow* a, const InputRow* b) { return width(a->gain_db) > width(b->gain_db); });
  std::string text = fmt::format(
      "{} links, {} samples of each; intervals hold 90% of them\nmedian width  path gain {:.2g} dB, "
      "delay spread {:.2g} ns\nshares        path gain: {}\n              delay spread: {}\n",
      study.rows.size(), study.samples, median_over(study, [](const InputRow& r) { return width(r.gain_db); }),
      median_over(study, [](const InputRow& r) { return width(r.delay_spread_ns); }),
      shares_line(study, &InputRow::gain_share), shares_line(study, &InputRow::delay_spread_share));
  text += fmt::format("samples       {:.3g} ms each, the first frame {:.3g} ms; {} of {} launched rays\n",
                      1e3 * study.sample_s, 1e3 * study.nominal_s, study.frames_with_rays, study.frames_run);
  text += study.late.discoveries == 0
              ? "what samples without rays lack was not measured: all launched rays\n"
              : fmt::format("samples without rays lack {:.2g} of the power, at most {:.2g} in one of {} looks\n",
                            study.late.power_share(), study.late.largest_share, study.late.discoveries);
  text += "widest intervals of path gain\n";
  for (size_t i = 0; i < std::min(shown, widest.size()); ++i) {
    const InputRow& row = *widest[i];
    text += fmt::format("  frame {}, {} to {}: {:.1f} to {:.1f} dB (nominal {}), {} of {} samples have a path\n",
                        row.frame, row.tx, row.rx, row.gain_db.low, row.gain_db.high,
                        std::isfinite(row.gain_db.nominal) ? fmt::format("{:.1f}", row.gain_db.nominal) : "none",
                        row.samples, study.samples);
  }
  return text;
}

plots::Figure inputs_figure(const InputStudy& study) {
  plots::Figure figure{.name = "inputs",
                       .title = "What errors of the inputs do to path gain",
                       .data = {{"inputs.csv", inputs_csv(study)}},
                       .commands = ""};
  figure.commands = fmt::format(
      "set datafile missing ''\nset xlabel 'width of the 90%% interval of path gain, dB'\n"
      "set ylabel 'share of links'\nset yrange [0:1]\nset xrange [0:*]\nset key off\n"
      "plot 'inputs.csv' skip 1 using (column(8) - column(6)):({:.9g}) smooth cumulative with lines linewidth 2\n",
      1.0 / static_cast<double>(study.rows.size()));
  return figure;
}

}  // namespace wavetracer::accuracy
