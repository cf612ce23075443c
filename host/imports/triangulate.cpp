// SPDX-License-Identifier: Apache-2.0
// Bridges are those of D. Eberly, "Triangulation by Ear Clipping" (2002), but each to the nearest visible corner; ears
// are those of G. Meisters, "Polygons have ears" (1975). The time grows as the square of the number of corners.
#include "imports/triangulate.hpp"

#include <algorithm>
#include <numeric>

namespace wavetracer::imports {
namespace {

class Clipper {
 public:
  explicit Clipper(const Polygon& polygon) {
    add_corners(polygon.outer);
    loop_.resize(points_.size());
    std::iota(loop_.begin(), loop_.end(), 0u);
    for (const Ring& hole : polygon.holes) {
      const auto first = static_cast<uint32_t>(points_.size());
      add_corners(hole);
      std::vector<uint32_t> corners(hole.size());
      std::iota(corners.begin(), corners.end(), first);
      // The rightmost corner comes first: the bridge starts there.
      std::rotate(corners.begin(),
                  std::max_element(corners.begin(), corners.end(),
                                   [this](uint32_t a, uint32_t b) { return points_[a] < points_[b]; }),
                  corners.end());
      holes_.push_back(std::move(corners));
    }
    // Holes are joined from the right: everything to the right of a hole's rightmost corner belongs to the loop
    // already.
    std::sort(holes_.begin(), holes_.end(),
              [this](const auto& a, const auto& b) { return points_[a[0]] > points_[b[0]]; });
  }

  std::vector<Triangle> run() {
    for (size_t i = 0; i < holes_.size(); ++i) {
      if (!bridge(i)) return {};
    }
    return clip();
  }

 private:
  void add_corners(const Ring& ring) { points_.insert(points_.end(), ring.begin(), ring.end()); }
  const Point& at(size_t i) const { return points_[loop_[i % loop_.size()]]; }

  // Tells whether p lies strictly between the edges of corner i of the loop, on the side of the polygon.
  bool in_corner(size_t i, const Point& p) const {
    const Point &before = at(i + loop_.size() - 1), &corner = at(i), &after = at(i + 1);
    const bool left_of_first = turn(before, corner, p) > 0, left_of_second = turn(corner, after, p) > 0;
    return turn(before, corner, after) > 0 ? left_of_first && left_of_second : left_of_first || left_of_second;
  }

  // Tells whether the edge p - q blocks the line from v to m. Edges that end at v or m may touch the line there.
  bool hides(const Point& p, const Point& q, const Point& v, const Point& m) const {
    const bool p_end = p == v || p == m, q_end = q == v || q == m;
    if (p_end && q_end) return false;
    if (p_end) return on_segment(v, m, q);
    if (q_end) return on_segment(v, m, p);
    return segments_meet(p, q, v, m);
  }
  bool sees(const Point& v, const Point& m, size_t first_hole) const {
    for (size_t i = 0; i < loop_.size(); ++i) {
      if (hides(at(i), at(i + 1), v, m)) return false;
    }
    for (size_t h = first_hole; h < holes_.size(); ++h) {
      const auto& hole = holes_[h];
      for (size_t i = 0; i < hole.size(); ++i) {
        if (hides(points_[hole[i]], points_[hole[(i + 1) % hole.size()]], v, m)) return false;
      }
    }
    return true;
  }

  // Cuts the loop open at the nearest corner that sees the hole, and inserts the hole's corners.
  bool bridge(size_t index) {
    const std::vector<uint32_t>& hole = holes_[index];
    const Point m = points_[hole[0]];
    std::vector<size_t> nearest(loop_.size());
    std::iota(nearest.begin(), nearest.end(), size_t{0});
    const auto distance = [&](size_t i) {
      const int64_t x = at(i).x - m.x, y = at(i).y - m.y;
      return x * x + y * y;
    };
    std::sort(nearest.begin(), nearest.end(), [&](size_t a, size_t b) { return distance(a) < distance(b); });
    for (const size_t i : nearest) {
      if (!in_corner(i, m) || !sees(at(i), m, index)) continue;
      std::vector<uint32_t> detour(hole.begin(), hole.end());
      detour.push_back(hole[0]);
      detour.push_back(loop_[i]);
      loop_.insert(loop_.begin() + static_cast<std::ptrdiff_t>(i) + 1, detour.begin(), detour.end());
      return true;
    }
    return false;
  }

  // Tells whether corner i turns left and no other corner lies in its triangle; the ends of bridges appear twice.
  bool is_ear(size_t i) const {
    const Point &a = at(i + loop_.size() - 1), &b = at(i), &c = at(i + 1);
    if (turn(a, b, c) <= 0) return false;
    for (const uint32_t other : loop_) {
      const Point& p = points_[other];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  // Tells whether the edge to corner i is also the edge back, as between two ears where an outline touches itself.
  bool is_spike(size_t i) const { return at(i + loop_.size() - 1) == at(i + 1) || at(i) == at(i + 1); }

  // Cutting an ear changes only the two corners beside it, so others are not tested again. Only where several bridges
  // lie on each other may more corners change; then all are tested once no ear is left.
  std::vector<Triangle> clip() {
    constexpr int most_looks = 10;  // number of rounds over all corners
    std::vector<Triangle> out;
    std::vector<char> ears;
    size_t i = 0, in_vain = 0;
    int looks = 0;
    const auto look = [&](size_t k) { ears[k % loop_.size()] = is_spike(k) || is_ear(k % loop_.size()); };
    while (loop_.size() > 3) {
      if (ears.empty() || in_vain == loop_.size()) {
        if (looks++ == most_looks) return {};
        ears.resize(loop_.size());
        for (size_t k = 0; k < loop_.size(); ++k) look(k);
        in_vain = 0;
      }
      i %= loop_.size();
      if (ears[i]) {
        cut(i, out);
        ears.erase(ears.begin() + static_cast<std::ptrdiff_t>(i));
        look(i);
        look(i + loop_.size() - 1);
        in_vain = 0;
      } else {
        ++in_vain;
      }
      ++i;  // after a cut, the next corner is skipped, which makes fans rarer
    }
    if (is_spike(0) || is_spike(1) || is_spike(2)) return out;
    if (turn(at(0), at(1), at(2)) <= 0) return {};
    out.push_back({loop_[0], loop_[1], loop_[2]});
    return out;
  }
  void cut(size_t i, std::vector<Triangle>& out) {
    const size_t n = loop_.size();
    if (!is_spike(i)) out.push_back({loop_[(i + n - 1) % n], loop_[i], loop_[(i + 1) % n]});
    loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(i));
  }

  std::vector<Point> points_;
  std::vector<uint32_t> loop_;                // the polygon as one ring, with bridges in both directions
  std::vector<std::vector<uint32_t>> holes_;  // clockwise, starting at their rightmost corner
};

}  // namespace

std::vector<Triangle> triangulate(const Polygon& polygon) { return Clipper(polygon).run(); }

}  // namespace wavetracer::imports
