// Rows are found by their link, because paths and links of a file need not be sorted.
// Spreads take a second pass over the paths, so that they keep their digits beside long delays.
#include "viewer/link_rows.hpp"
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <type_traits>

namespace wavetracer {
namespace {

std::vector<LinkRow> empty_rows(const SavedFrame& frame, std::span<const double> missed_power_share) {
  std::vector<LinkRow> rows;
  rows.reserve(frame.links.size());
  for (size_t k = 0; k < frame.links.size(); ++k) {
    rows.push_back({.link = frame.links[k]});
    if (k < missed_power_share.size()) rows.back().missed_power_share = missed_power_share[k];
  }
  for (size_t i = 0; i < frame.paths.size(); ++i) {
    const Link link{frame.paths.tx[i], frame.paths.rx[i]};
    if (rows.empty() || rows.back().link != link) rows.push_back({.link = link});
  }
  // Of rows of one link the first is kept: the one with a share, if any has.
  std::stable_sort(rows.begin(), rows.end(), [](const LinkRow& a, const LinkRow& b) { return a.link < b.link; });
  rows.erase(std::unique(rows.begin(), rows.end(), [](const LinkRow& a, const LinkRow& b) { return a.link == b.link; }),
             rows.end());
  return rows;
}

// |h|^2 at the carrier, as radio/links.cpp has it. Whole turns of the phase are left out before the sine is taken.
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

}  // namespace

double LinkRow::gain_db() const {
  return power > 0 ? 10 * std::log10(power) : -std::numeric_limits<double>::infinity();
}

std::vector<LinkRow> link_rows(const SavedFrame& frame, std::span<const double> missed_power_share,
                               double frequency_hz) {
  std::vector<LinkRow> rows = empty_rows(frame, missed_power_share);
  const Paths& paths = frame.paths;
  std::vector<size_t> row_of(paths.size());
  std::vector<double> power(paths.size()), mean_s(rows.size(), 0), square_s2(rows.size(), 0);
  for (size_t i = 0; i < paths.size(); ++i) {
    const Link link{paths.tx[i], paths.rx[i]};
    const auto found = std::lower_bound(rows.begin(), rows.end(), link,
                                        [](const LinkRow& row, const Link& wanted) { return row.link < wanted; });
    row_of[i] = static_cast<size_t>(found - rows.begin());
    power[i] = std::pow(10.0, paths.gain_db[i] / 10);
    LinkRow& row = rows[row_of[i]];
    ++row.paths;
    row.los |= paths.depth[i] == 0;
    row.power += power[i];
    mean_s[row_of[i]] += power[i] * paths.delay_s[i];
  }
  add_narrowband_gains(paths, row_of, frequency_hz, rows);
  for (size_t k = 0; k < rows.size(); ++k) mean_s[k] /= rows[k].power;
  for (size_t i = 0; i < paths.size(); ++i)
    square_s2[row_of[i]] += power[i] * std::pow(paths.delay_s[i] - mean_s[row_of[i]], 2);
  for (size_t k = 0; k < rows.size(); ++k)
    if (rows[k].power > 0) rows[k].rms_delay_spread_s = std::sqrt(square_s2[k] / rows[k].power);
  return rows;
}

}  // namespace wavetracer
