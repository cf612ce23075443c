// SPDX-License-Identifier: Apache-2.0
// Lines parallel to x are cut by all edges that they cross: this gives the lengths inside the polygon, and inside
// others as well. Where a line passes through a corner, each edge counts by its lower end alone.
#include "imports/coverage.hpp"

#include <algorithm>
#include <cmath>

namespace wavetracer::imports {
namespace {

constexpr size_t coverage_lines = 256;

struct Cut {
  double x;
  size_t polygon;  // 0: the covered polygon; others count from 1
};

class CoverageLines {
 public:
  explicit CoverageLines(const Polygon& polygon) : cuts_(coverage_lines) {
    const Box box = box_of(polygon.outer);
    lower_ = static_cast<double>(box.lower.y);
    spacing_ = static_cast<double>(box.upper.y - box.lower.y) / coverage_lines;
  }

  void add(const Polygon& polygon, size_t number) {
    add(polygon.outer, number);
    for (const Ring& hole : polygon.holes) add(hole, number);
  }

  double share(size_t polygons) {
    double inside = 0, covered = 0;
    for (std::vector<Cut>& cuts : cuts_) {
      std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.x < b.x; });
      std::vector<bool> within(polygons, false);
      size_t others = 0;
      for (size_t i = 0; i < cuts.size(); ++i) {
        const size_t number = cuts[i].polygon;
        within[number] = !within[number];
        if (number > 0) others = within[number] ? others + 1 : others - 1;
        if (i + 1 == cuts.size() || !within[0]) continue;
        inside += cuts[i + 1].x - cuts[i].x;
        if (others > 0) covered += cuts[i + 1].x - cuts[i].x;
      }
    }
    return inside > 0 ? covered / inside : 0;
  }

 private:
  void add(const Ring& ring, size_t number) {
    for (size_t i = 0; i < ring.size(); ++i) {
      Point a = ring[i], b = ring[(i + 1) % ring.size()];
      if (a.y > b.y) std::swap(a, b);
      const auto x = static_cast<double>(a.x), y = static_cast<double>(a.y);
      const double slope = a.y == b.y ? 0 : static_cast<double>(b.x - a.x) / static_cast<double>(b.y - a.y);
      for (size_t line = first_from(y), end = first_from(static_cast<double>(b.y)); line < end; ++line)
        cuts_[line].push_back({x + slope * (height(line) - y), number});
    }
  }

  double height(size_t line) const { return lower_ + (static_cast<double>(line) + 0.5) * spacing_; }
  // Returns the first line at this y or above.
  size_t first_from(double y) const {
    const double line = std::ceil((y - lower_) / spacing_ - 0.5);
    return static_cast<size_t>(std::clamp(line, 0.0, static_cast<double>(coverage_lines)));
  }

  double lower_, spacing_;
  std::vector<std::vector<Cut>> cuts_;  // the cuts of each line
};

}  // namespace

double covered_share(const Polygon& polygon, std::span<const Polygon* const> others) {
  CoverageLines lines(polygon);
  lines.add(polygon, 0);
  for (size_t i = 0; i < others.size(); ++i) lines.add(*others[i], i + 1);
  return lines.share(others.size() + 1);
}

}  // namespace wavetracer::imports
