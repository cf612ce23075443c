// Figures of a link from its paths, in two passes so that spreads keep their digits beside long delays.
// Assumes that every row has tx < tx_count and rx < rx_count.
#include "radio/links.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wavetracer {
namespace {

double power_of(const Paths& paths, size_t row) {
  double power = 0;
  for (const auto& a : paths.a[row]) power += std::norm(a);
  return power;
}

struct Moments {
  double mean, rms;  // rms about the mean
};

Moments moments(const Paths& paths, const std::vector<size_t>& rows, const std::vector<double>& values, double power) {
  double mean = 0, square = 0;
  for (const size_t row : rows) mean += power_of(paths, row) / power * values[row];
  for (const size_t row : rows) square += power_of(paths, row) / power * std::pow(values[row] - mean, 2);
  return {mean, std::sqrt(square)};
}

LinkFigures figures(const Paths& paths, const std::vector<size_t>& rows) {
  LinkFigures link;
  link.paths = static_cast<uint32_t>(rows.size());
  link.los = std::any_of(rows.begin(), rows.end(), [&](size_t row) { return paths.depth[row] == 0; });
  double power = 0;
  for (const size_t row : rows) power += power_of(paths, row);
  link.path_gain_db = 10 * std::log10(power);
  if (power > 0) {
    const Moments delay = moments(paths, rows, paths.delay_s, power);
    link.mean_delay_s = delay.mean;
    link.rms_delay_spread_s = delay.rms;
    link.doppler_spread_hz = moments(paths, rows, paths.doppler_hz, power).rms;
  } else {
    link.mean_delay_s = link.rms_delay_spread_s = link.doppler_spread_hz = std::numeric_limits<double>::quiet_NaN();
  }
  return link;
}

}  // namespace

std::vector<LinkFigures> link_figures(const Paths& paths, uint32_t frame, uint32_t tx_count, uint32_t rx_count) {
  std::vector<std::vector<size_t>> rows(size_t{tx_count} * rx_count);
  for (size_t row = 0; row < paths.size(); ++row) {
    if (paths.frame[row] == frame) rows[size_t{paths.tx[row]} * rx_count + paths.rx[row]].push_back(row);
  }
  std::vector<LinkFigures> links;
  links.reserve(rows.size());
  for (const std::vector<size_t>& of_link : rows) {
    LinkFigures link = figures(paths, of_link);
    link.frame = frame;
    link.tx = static_cast<uint32_t>(links.size() / rx_count);
    link.rx = static_cast<uint32_t>(links.size() % rx_count);
    links.push_back(link);
  }
  return links;
}

}  // namespace wavetracer
