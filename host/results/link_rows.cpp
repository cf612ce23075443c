// SPDX-License-Identifier: Apache-2.0
// Rows are found by their link, because paths and links of a file need not be sorted.
// Spreads take a second pass over the paths, so that they keep their digits beside long delays.
#include "results/link_rows.hpp"
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <type_traits>
#include "radio/grouped_power.hpp"

namespace wavetracer {
namespace {

std::vector<LinkRow> empty_rows(const SavedFrame& frame) {
  std::vector<LinkRow> rows;
  rows.reserve(frame.links.size());
  for (const Link& link : frame.links) rows.push_back({.link = link});
  for (size_t i = 0; i < frame.paths.size(); ++i) {
    const Link link{frame.paths.tx[i], frame.paths.rx[i]};
    if (rows.empty() || rows.back().link != link) rows.push_back({.link = link});
  }
  std::sort(rows.begin(), rows.end(), [](const LinkRow& a, const LinkRow& b) { return a.link < b.link; });
  rows.erase(std::unique(rows.begin(), rows.end(), [](const LinkRow& a, const LinkRow& b) { return a.link == b.link; }),
             rows.end());
  return rows;
}

// Adds |h|^2 at the carrier, as in radio/links.cpp. Whole turns of the phase are removed before the sine is taken.
void add_narrowband_gains(const Paths& paths, const std::vector<size_t>& row_of, double frequency_hz,
                          std::vector<LinkRow>& rows) {
  using Response = std::remove_cvref_t<decltype(paths.a[0])>;
  std::vector<Response> h(rows.size(), Response{});
  for (size_t i = 0; i < paths.size(); ++i) {
    const double turns = frequency_hz * paths.delay_s[i];
    const std::complex<double> carrier = std::polar(1.0, -2 * std::numbers::pi * (turns - std::floor(turns)));
    for (size_t port = 0; port < h[row_of[i]].size(); ++port) h[row_of[i]][port] += paths.a[i][port] * carrier;
  }
  for (size_t k = 0; k < rows.size(); ++k) {
    double power = 0;
    for (const std::complex<double>& part : h[k]) power += std::norm(part);
    if (power > 0) rows[k].narrowband_gain_db = 10 * std::log10(power);
  }
}

// Adds path gains as in radio/grouped_power.hpp. Paths of a link may be apart in a file; then the file has no groups of
// them.
void add_path_gains(const Paths& paths, const std::vector<size_t>& row_of, double frequency_hz,
                    std::vector<LinkRow>& rows) {
  std::vector<double> power(rows.size(), 0);
  for (size_t first = 0, end = 0; first < paths.size(); first = end) {
    while (end < paths.size() && row_of[end] == row_of[first]) ++end;
    power[row_of[first]] += grouped_power(paths, first, end, frequency_hz);
  }
  for (size_t k = 0; k < rows.size(); ++k)
    if (power[k] > 0) rows[k].path_gain_db = 10 * std::log10(power[k]);
}

// Sets K factors. paths.h5 may lack the share `left_out` of the power of all paths of a link.
void add_k_factors(const Paths& paths, const std::vector<size_t>& row_of, const std::vector<double>& path_power,
                   const std::vector<double>& left_out, std::vector<LinkRow>& rows) {
  std::vector<double> direct(rows.size(), 0), others(rows.size(), 0);
  for (size_t i = 0; i < paths.size(); ++i) (paths.depth[i] == 0 ? direct : others)[row_of[i]] += path_power[i];
  for (size_t k = 0; k < rows.size(); ++k) {
    const double gone = left_out[k] * (direct[k] + others[k]) / (1 - left_out[k]);
    if (direct[k] > 0) rows[k].k_factor = direct[k] / (others[k] + gone);
  }
}

// Returns the row of a link, which must exist.
size_t row_of_link(const std::vector<LinkRow>& rows, const Link& link) {
  const auto found = std::lower_bound(rows.begin(), rows.end(), link,
                                      [](const LinkRow& row, const Link& wanted) { return row.link < wanted; });
  return static_cast<size_t>(found - rows.begin());
}

// Takes the number of a beam, of which a codebook has at most 65536; other values are those of a file that is damaged.
void take_beam(const std::vector<double>& column, size_t at, std::optional<uint32_t>& beam) {
  constexpr double beams = 65536;
  if (at < column.size() && column[at] >= 0 && column[at] < beams) beam = static_cast<uint32_t>(column[at]);
}

// left_out: set to the share of the power that paths.h5 lacks, for each row.
void take_table(const SavedFrame& frame, const LinkTable& table, uint64_t first_link, std::vector<LinkRow>& rows,
                std::vector<double>& left_out) {
  for (size_t k = 0; k < frame.links.size(); ++k) {
    const size_t number = row_of_link(rows, frame.links[k]);
    LinkRow& row = rows[number];
    const size_t at = first_link + k;
    const auto take = [at](const std::vector<double>& column, auto& value) {
      if (at < column.size()) value = static_cast<std::remove_cvref_t<decltype(value)>>(column[at]);
    };
    if (at < table.paths.size() && table.paths[at] >= 0 && table.paths[at] <= 4e9) take(table.paths, row.paths);
    if (at < table.los.size()) row.los = table.los[at] == 1;
    take(table.path_gain_db, row.path_gain_db);
    take(table.narrowband_gain_db, row.narrowband_gain_db);
    take(table.rms_delay_spread_s, row.rms_delay_spread_s);
    take(table.missed_power_share, row.missed_power_share);
    take(table.left_out_power_share, left_out[number]);
    row.left_out_power_share = left_out[number];
    take_beam(table.tx_beam, at, row.tx_beam);
    take_beam(table.rx_beam, at, row.rx_beam);
    take(table.beam_gain_db, row.beam_gain_db);
    if (at < table.k_factor_db.size()) row.k_factor = std::pow(10.0, table.k_factor_db[at] / 10);
  }
}

}  // namespace

std::vector<LinkRow> link_rows(const SavedFrame& frame, const LinkTable& table, uint64_t first_link,
                               double frequency_hz) {
  std::vector<LinkRow> rows = empty_rows(frame);
  const Paths& paths = frame.paths;
  std::vector<size_t> row_of(paths.size());
  std::vector<double> path_power(paths.size()), power(rows.size(), 0), mean_s(rows.size(), 0),
      square_s2(rows.size(), 0);
  for (size_t i = 0; i < paths.size(); ++i) {
    const size_t k = row_of[i] = row_of_link(rows, {paths.tx[i], paths.rx[i]});
    path_power[i] = std::pow(10.0, paths.gain_db[i] / 10);
    ++rows[k].paths;
    rows[k].los |= paths.depth[i] == 0;
    power[k] += path_power[i];
    mean_s[k] += path_power[i] * paths.delay_s[i];
  }
  add_path_gains(paths, row_of, frequency_hz, rows);
  add_narrowband_gains(paths, row_of, frequency_hz, rows);
  for (size_t k = 0; k < rows.size(); ++k) mean_s[k] /= power[k];
  for (size_t i = 0; i < paths.size(); ++i)
    square_s2[row_of[i]] += path_power[i] * std::pow(paths.delay_s[i] - mean_s[row_of[i]], 2);
  for (size_t k = 0; k < rows.size(); ++k)
    if (power[k] > 0) rows[k].rms_delay_spread_s = std::sqrt(square_s2[k] / power[k]);
  std::vector<double> left_out(rows.size(), 0);
  take_table(frame, table, first_link, rows, left_out);
  if (table.k_factor_db.empty()) add_k_factors(paths, row_of, path_power, left_out, rows);
  return rows;
}

}  // namespace wavetracer
