// SPDX-License-Identifier: Apache-2.0
// Figures of a link from its paths, in two passes so that spreads keep their digits beside long delays.
// Rows and links must be sorted; they are walked once, side by side.
#include "radio/links.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "radio/grouped_power.hpp"
#include "radio/path_power.hpp"
#include "wavetracer/missed.hpp"

namespace wavetracer {
namespace {

struct Moments {
  double mean, rms;  // rms: about the mean
};

struct RowRange {
  size_t begin, end;
};

Moments moments(const Paths& paths, RowRange rows, const std::vector<double>& values, double power) {
  double mean = 0, square = 0;
  for (size_t row = rows.begin; row < rows.end; ++row) mean += power_of(paths, row) / power * values[row];
  for (size_t row = rows.begin; row < rows.end; ++row)
    square += power_of(paths, row) / power * std::pow(values[row] - mean, 2);
  return {mean, std::sqrt(square)};
}

// |h|^2 at the carrier, summed over pairs of ports.
double narrowband_power(const Paths& paths, RowRange rows, double frequency_hz) {
  std::remove_cvref_t<decltype(paths.a[0])> sum{};
  for (size_t row = rows.begin; row < rows.end; ++row) {
    const std::complex<double> carrier = carrier_phase(frequency_hz, paths.delay_s[row]);
    for (size_t k = 0; k < sum.size(); ++k) sum[k] += paths.a[row][k] * carrier;
  }
  double power = 0;
  for (const auto& h : sum) power += std::norm(h);
  return power;
}

LinkFigures figures(const Paths& paths, RowRange rows, double frequency_hz) {
  LinkFigures link;
  link.paths = static_cast<uint32_t>(rows.end - rows.begin);
  double power = 0, direct = 0, others = 0;
  for (size_t row = rows.begin; row < rows.end; ++row) {
    const double own = power_of(paths, row);
    power += own;
    (paths.depth[row] == 0 ? direct : others) += own;
    link.los |= paths.depth[row] == 0;
  }
  link.k_factor = direct > 0 ? direct / others : std::numeric_limits<double>::quiet_NaN();
  link.path_gain_db = 10 * std::log10(grouped_power(paths, rows.begin, rows.end, frequency_hz));
  link.sum_of_powers_db = 10 * std::log10(power);
  link.narrowband_gain_db = 10 * std::log10(narrowband_power(paths, rows, frequency_hz));
  if (power > 0) {
    const Moments delay = moments(paths, rows, paths.delay_s, power);
    link.mean_delay_s = delay.mean;
    link.rms_delay_spread_s = delay.rms;
    link.doppler_spread_hz = moments(paths, rows, paths.doppler_hz, power).rms;
  } else {
    link.mean_delay_s = link.rms_delay_spread_s = link.doppler_spread_hz = std::numeric_limits<double>::quiet_NaN();
  }
  const MissedCounts missed = missed_counts(paths, rows.begin, rows.end);
  link.missed_power_share = missed.frames > 0 && power > 0 ? estimate_missed(missed).power_share.estimate
                                                           : std::numeric_limits<double>::quiet_NaN();
  return link;
}

}  // namespace

std::vector<LinkFigures> link_figures(const Paths& paths, uint32_t frame, std::span<const Link> links,
                                      double frequency_hz) {
  const auto link_of = [&paths](size_t row) { return Link{paths.tx[row], paths.rx[row]}; };
  const auto [first, last] = std::equal_range(paths.frame.begin(), paths.frame.end(), frame);
  size_t row = static_cast<size_t>(first - paths.frame.begin());
  const size_t end = static_cast<size_t>(last - paths.frame.begin());
  std::vector<LinkFigures> out;
  out.reserve(links.size());
  for (const Link& link : links) {
    while (row < end && link_of(row) < link) ++row;
    RowRange rows{row, row};
    while (rows.end < end && link_of(rows.end) == link) ++rows.end;
    row = rows.end;
    out.push_back(figures(paths, rows, frequency_hz));
    out.back().frame = frame;
    out.back().tx = link.tx;
    out.back().rx = link.rx;
  }
  return out;
}

}  // namespace wavetracer
