// SPDX-License-Identifier: Apache-2.0
// Merges two lists sorted by link and delay: only paths within the tolerance of each other are compared. Powers must
// agree within 1e-6 of themselves: the same path solved from its other end differs in the last bits alone.
#include "path_recall.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "radio/path_power.hpp"

namespace wavetracer::bench {
namespace {

constexpr double delay_tolerance_s = 1e-12, power_tolerance = 1e-6;

auto link_of(const Paths& paths, size_t i) { return std::tuple(paths.tx[i], paths.rx[i]); }

bool same_sequence(const Paths& a, size_t i, const Paths& b, size_t j) {
  const auto equal = [&](const std::vector<uint32_t>& x, const std::vector<uint32_t>& y) {
    const auto first = [](const Paths& p, size_t row) { return static_cast<std::ptrdiff_t>(p.vertex_offset[row]); };
    return std::equal(x.begin() + first(a, i), x.begin() + first(a, i + 1), y.begin() + first(b, j),
                      y.begin() + first(b, j + 1));
  };
  return equal(a.vertex_surface, b.vertex_surface) && equal(a.vertex_instance, b.vertex_instance);
}

bool same_power(double a, double b) { return std::abs(a - b) <= power_tolerance * std::max(a, b); }

}  // namespace

std::vector<size_t> matching_rows(const Paths& reference, const Paths& mine) {
  std::vector<bool> taken(mine.size(), false);
  std::vector<size_t> rows(reference.size(), no_row);
  size_t first = 0;  // first row of mine that is not before reference path i minus the tolerance
  const auto is_before = [&](size_t j, size_t i) {
    return link_of(mine, j) < link_of(reference, i) ||
           (link_of(mine, j) == link_of(reference, i) && mine.delay_s[j] < reference.delay_s[i] - delay_tolerance_s);
  };
  for (size_t i = 0; i < reference.size(); i++) {
    const double own_power = power_of(reference, i);
    while (first < mine.size() && is_before(first, i)) first++;
    for (size_t j = first; j < mine.size() && link_of(mine, j) == link_of(reference, i) &&
                           mine.delay_s[j] <= reference.delay_s[i] + delay_tolerance_s;
         j++) {
      if (taken[j]) continue;
      if (same_sequence(reference, i, mine, j)) {
        rows[i] = j;
        break;
      }
      if (rows[i] == no_row && same_power(own_power, power_of(mine, j))) rows[i] = j;
    }
    if (rows[i] != no_row) taken[rows[i]] = true;
  }
  return rows;
}

PathRecall path_recall(const Paths& reference, const Paths& mine) {
  const std::vector<size_t> rows = matching_rows(reference, mine);
  PathRecall recall{.reference = reference.size(), .mine = mine.size()};
  double power = 0, found_power = 0;
  for (size_t i = 0; i < reference.size(); i++) {
    const double own_power = power_of(reference, i);
    power += own_power;
    if (rows[i] == no_row) continue;
    recall.found++;
    found_power += own_power;
  }
  if (recall.reference > 0) recall.paths = static_cast<double>(recall.found) / static_cast<double>(recall.reference);
  if (power > 0) recall.power = found_power / power;
  return recall;
}

}  // namespace wavetracer::bench
