// Rows are found by their link, because paths and links of a file need not be sorted.
// Spreads take a second pass over the paths, so that they keep their digits beside long delays.
#include "viewer/link_rows.hpp"
#include <algorithm>
#include <cmath>

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

}  // namespace

double LinkRow::gain_db() const {
  return power > 0 ? 10 * std::log10(power) : -std::numeric_limits<double>::infinity();
}

std::vector<LinkRow> link_rows(const SavedFrame& frame, std::span<const double> missed_power_share) {
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
  for (size_t k = 0; k < rows.size(); ++k) mean_s[k] /= rows[k].power;
  for (size_t i = 0; i < paths.size(); ++i)
    square_s2[row_of[i]] += power[i] * std::pow(paths.delay_s[i] - mean_s[row_of[i]], 2);
  for (size_t k = 0; k < rows.size(); ++k)
    if (rows[k].power > 0) rows[k].rms_delay_spread_s = std::sqrt(square_s2[k] / rows[k].power);
  return rows;
}

}  // namespace wavetracer
