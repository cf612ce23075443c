// SPDX-License-Identifier: Apache-2.0
// Tests rings exactly. Crossings are found by a sweep over the edges sorted by their lower x.
// fault() checks sizes before any product can overflow.
#include "imports/rings.hpp"

#include <algorithm>
#include <cmath>

namespace wavetracer::imports {
namespace {

int sign(int64_t value) { return (value > 0) - (value < 0); }

struct Segment {
  Point a, b;
  size_t ring = 0, place = 0, ring_size = 0;
  int64_t lower_x() const { return std::min(a.x, b.x); }
  int64_t upper_x() const { return std::max(a.x, b.x); }
};

void append(std::vector<Segment>& out, const Ring& ring, size_t index) {
  for (size_t i = 0; i < ring.size(); ++i) out.push_back({ring[i], ring[(i + 1) % ring.size()], index, i, ring.size()});
}

// Tells whether two edges have more in common than the corner that neighbours share.
bool collide(const Segment& s, const Segment& t) {
  if (s.ring == t.ring) {
    if ((s.place + 1) % s.ring_size == t.place) return on_segment(s.a, s.b, t.b) || on_segment(t.a, t.b, s.a);
    if ((t.place + 1) % t.ring_size == s.place) return on_segment(t.a, t.b, s.b) || on_segment(s.a, s.b, t.a);
  }
  return segments_meet(s.a, s.b, t.a, t.b);
}

size_t corners_of(const Polygon& polygon) {
  size_t corners = polygon.outer.size();
  for (const Ring& hole : polygon.holes) corners += hole.size();
  return corners;
}

bool any_collision(const Polygon& polygon) {
  std::vector<Segment> segments;
  append(segments, polygon.outer, 0);
  for (size_t i = 0; i < polygon.holes.size(); ++i) append(segments, polygon.holes[i], i + 1);
  std::sort(segments.begin(), segments.end(),
            [](const Segment& s, const Segment& t) { return s.lower_x() < t.lower_x(); });
  for (size_t i = 0; i < segments.size(); ++i) {
    for (size_t j = i + 1; j < segments.size() && segments[j].lower_x() <= segments[i].upper_x(); ++j) {
      if (collide(segments[i], segments[j])) return true;
    }
  }
  return false;
}

constexpr size_t coverage_lines = 256;

struct Cut {
  double x;
  size_t polygon;  // 0: the covered polygon; others count from 1
};

// Lines parallel to x are cut by all edges that they cross: this gives the lengths inside the polygon, and inside
// others as well. Where a line passes through a corner, each edge counts by its lower end alone.
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

bool on_segment(const Point& a, const Point& b, const Point& p) {
  return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d) {
  if (std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) return false;
  const int c_side = sign(turn(a, b, c)), d_side = sign(turn(a, b, d));
  const int a_side = sign(turn(c, d, a)), b_side = sign(turn(c, d, b));
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
}

Ring make_ring(std::span<const glm::dvec2> points_m) {
  Ring out;
  for (const glm::dvec2& p : points_m) {
    const Point q{std::llround(p.x * grid_per_m), std::llround(p.y * grid_per_m)};
    if (out.empty() || out.back() != q) out.push_back(q);
  }
  while (out.size() > 1 && out.back() == out.front()) out.pop_back();
  return out;
}

Box box_of(const Ring& ring) {
  Box out{ring.front(), ring.front()};
  for (const Point& p : ring) {
    out.lower = {std::min(out.lower.x, p.x), std::min(out.lower.y, p.y)};
    out.upper = {std::max(out.upper.x, p.x), std::max(out.upper.y, p.y)};
  }
  return out;
}

int64_t twice_area(const Ring& ring) {
  int64_t sum = 0;
  for (size_t i = 1; i + 1 < ring.size(); ++i) sum += turn(ring[0], ring[i], ring[i + 1]);
  return sum;
}

double area_m2(const Polygon& polygon) {
  int64_t sum = twice_area(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += twice_area(hole);
  return static_cast<double>(sum) / (2.0 * grid_per_m * grid_per_m);
}

void orient(Polygon& polygon) {
  if (twice_area(polygon.outer) < 0) std::reverse(polygon.outer.begin(), polygon.outer.end());
  for (Ring& hole : polygon.holes) {
    if (twice_area(hole) > 0) std::reverse(hole.begin(), hole.end());
  }
}

bool contains(const Ring& ring, const Point& p) {
  bool inside = false;
  for (size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Point &a = ring[j], &b = ring[i];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if ((turn(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

std::string_view fault(const Polygon& polygon) {
  if (corners_of(polygon) > max_corners) return "more than 5000 corners";
  if (polygon.outer.size() < 3) return "fewer than three corners";
  const Box box = box_of(polygon.outer);
  constexpr auto limit = static_cast<int64_t>(largest_coordinate_m) * grid_per_m;
  if (box.lower.x < -limit || box.lower.y < -limit || box.upper.x > limit || box.upper.y > limit) {
    return "too far from the middle of the map";
  }
  if (box.upper.x - box.lower.x > max_size || box.upper.y - box.lower.y > max_size) return "larger than 4 km";
  for (const Ring& hole : polygon.holes) {
    if (hole.size() < 3) return "a courtyard of fewer than three corners";
    if (!box.contains(box_of(hole))) return "a courtyard outside of the building";
  }
  if (twice_area(polygon.outer) == 0) return "no area";
  if (any_collision(polygon)) return crossing_outline;
  for (size_t i = 0; i < polygon.holes.size(); ++i) {
    if (!contains(polygon.outer, polygon.holes[i][0])) return "a courtyard outside of the building";
    for (size_t j = 0; j < polygon.holes.size(); ++j) {
      if (i != j && contains(polygon.holes[j], polygon.holes[i][0])) return "a courtyard inside of another";
    }
  }
  return {};
}

bool fits(const Polygon& polygon, const Ring& hole) {
  if (corners_of(polygon) + hole.size() > max_corners || !contains(polygon.outer, hole[0])) return false;
  const Box box = box_of(hole);
  const auto meets = [&](const Ring& ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (std::max(a.x, b.x) < box.lower.x || std::min(a.x, b.x) > box.upper.x) continue;
      for (size_t k = 0; k < hole.size(); ++k) {
        if (segments_meet(a, b, hole[k], hole[(k + 1) % hole.size()])) return true;
      }
    }
    return false;
  };
  return !meets(polygon.outer) && std::none_of(polygon.holes.begin(), polygon.holes.end(), [&](const Ring& other) {
    return contains(other, hole[0]) || contains(hole, other[0]) || meets(other);
  });
}

double covered_share(const Polygon& polygon, std::span<const Polygon* const> others) {
  CoverageLines lines(polygon);
  lines.add(polygon, 0);
  for (size_t i = 0; i < others.size(); ++i) lines.add(*others[i], i + 1);
  return lines.share(others.size() + 1);
}

}  // namespace wavetracer::imports
