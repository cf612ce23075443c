// SPDX-License-Identifier: Apache-2.0
// A number without a value is an empty cell.
#include "accuracy/table.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include "accuracy/advice.hpp"
#include "base/csv_columns.hpp"
#include "base/digits.hpp"
#include "base/times.hpp"

namespace wavetracer::accuracy {
namespace {

std::string number(double value) { return std::isfinite(value) ? six_digits(value) : ""; }
std::string count(const Row& row, uint64_t value) { return row.measured() ? std::to_string(value) : ""; }
std::string truth(bool value) { return value ? "true" : "false"; }
std::string note(const Row& row) {
  return row.measured() ? fmt::format("{}", fmt::join(row.warnings, "; ")) : "not measured: " + row.refusal;
}

const Columns<Row>& columns() {
  static const Columns<Row> all = {
      {"axis", [](const Row& r) { return r.setting.axis; }},
      {"setting", [](const Row& r) { return r.setting.name; }},
      {"reference", [](const Row& r) { return truth(r.reference); }},
      {"own", [](const Row& r) { return truth(r.own); }},
      {"frame_s", [](const Row& r) { return number(r.frame_s); }},
      {"paths", [](const Row& r) { return count(r, r.paths); }},
      {"lost_paths", [](const Row& r) { return number(r.error.lost_share); }},
      {"lost_power", [](const Row& r) { return number(r.error.lost_power); }},
      {"gain_median_db", [](const Row& r) { return number(r.error.power_median_db); }},
      {"gain_worst_db", [](const Row& r) { return number(r.error.power_max_db); }},
      {"delay_spread_ns", [](const Row& r) { return number(r.error.delay_spread_ns); }},
      {"doppler_spread_hz", [](const Row& r) { return number(r.error.doppler_spread_hz); }},
      {"links", [](const Row& r) { return count(r, r.error.links); }},
      {"links_lost", [](const Row& r) { return count(r, r.error.links_lost); }},
      {"keys", [](const Row& r) { return fmt::format("{}", fmt::join(r.setting.keys, " ")); }},
      {"note", [](const Row& r) { return note(r); }},
  };
  return all;
}

// A smaller error is that of rounding: between two solutions of the same paths.
constexpr double least_error = 1e-9;

std::string rounded(double value) {
  return !std::isfinite(value) ? "" : std::abs(value) < least_error ? "0" : fmt::format("{:.2g}", value);
}

std::string share_cell(double share) { return std::isnan(share) ? "" : share == 0 ? "0" : share_text(share); }

}  // namespace

const std::vector<std::string>& csv_columns() {
  static const std::vector<std::string> names = names_of(columns());
  return names;
}

std::string encode_csv(const std::vector<Row>& rows) { return csv_of(columns(), rows).text(); }

std::vector<std::string> short_columns() {
  return {"axis",
          "setting",
          "",
          "frame",
          "paths",
          "lost paths",
          "lost power",
          "gain dB",
          "worst link dB",
          "delay spread ns",
          "Doppler spread Hz",
          "links lost"};
}

std::vector<std::string> short_cells(const Row& row) {
  const study::PathError& e = row.error;
  const std::string role = row.reference ? row.own ? "reference, yours" : "reference" : row.own ? "yours" : "";
  if (!row.measured()) return {row.setting.axis, row.setting.name, note(row), "", "", "", "", "", "", "", "", ""};
  return {row.setting.axis,
          row.setting.name,
          role,
          duration_text(row.frame_s),
          grouped(row.paths),
          share_cell(e.lost_share),
          share_cell(e.lost_power),
          rounded(e.power_median_db),
          rounded(e.power_max_db),
          rounded(e.delay_spread_ns),
          rounded(e.doppler_spread_hz),
          grouped(e.links_lost)};
}

std::string encode_text(const std::vector<Row>& rows) {
  // Names are shorter than on the page, so that a row fits a terminal.
  std::vector<std::vector<std::string>> lines = {{"axis", "setting", "", "frame", "paths", "lost paths", "lost power",
                                                  "gain dB", "worst dB", "delay ns", "Doppler Hz", "links lost"}};
  for (const Row& row : rows) lines.push_back(short_cells(row));
  std::vector<size_t> widths(lines.front().size(), 0);
  for (size_t line = 0; line < lines.size(); ++line)
    if (line == 0 || rows[line - 1].measured())
      for (size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], lines[line][i].size());
    else
      for (size_t i = 0; i < 2; ++i) widths[i] = std::max(widths[i], lines[line][i].size());
  std::string text;
  for (const std::vector<std::string>& cells : lines) {
    std::string line;
    for (size_t i = 0; i < cells.size(); ++i)
      line += i < 3 ? fmt::format("{:<{}}  ", cells[i], widths[i]) : fmt::format("{:>{}}  ", cells[i], widths[i]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace wavetracer::accuracy
