// SPDX-License-Identifier: Apache-2.0
// Builds a graph of corners and walls. At each corner the two walls that form the straightest pair are connected, then
// the next two.
#include "imports/straight_walls.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

namespace wavetracer::imports {
namespace {

using glm::dvec2;
constexpr double least_move_m = 1e-4;  // a smaller move does not matter on the grid of polygons (rings.hpp)
constexpr uint32_t no_corner = 0xFFFFFFFFu;

double distance_from_line(const dvec2& p, const dvec2& a, const dvec2& b) {
  const dvec2 along = glm::normalize(b - a), d = p - a;
  return std::abs(along.x * d.y - along.y * d.x);
}

template <class Visit>
void each_ring(std::span<const Footprint> footprints, const Visit& visit) {
  for (const Footprint& footprint : footprints) {
    visit(footprint.outer);
    for (const RingM& hole : footprint.holes) visit(hole);
  }
}

class WallGraph {
 public:
  WallGraph(std::span<const Footprint> footprints, double tolerance_m) : tolerance_m_(tolerance_m) {
    each_ring(footprints, [this](const RingM& ring) { corners_.insert(corners_.end(), ring.begin(), ring.end()); });
    std::sort(corners_.begin(), corners_.end(), LessPoint());
    corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    walls_.resize(corners_.size());
    each_ring(footprints, [this](const RingM& ring) {
      for (size_t i = 0; i < ring.size(); ++i) {
        const uint32_t a = number(ring[i]), b = number(ring[(i + 1) % ring.size()]);
        if (a == b) continue;
        walls_[a].push_back({b, no_corner});
        walls_[b].push_back({a, no_corner});
      }
    });
    for (uint32_t c = 0; c < corners_.size(); ++c) {
      auto& walls = walls_[c];
      std::sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.to < b.to; });
      walls.erase(std::unique(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.to == b.to; }),
                  walls.end());
      pair_up(c);
    }
  }

  StraightWalls straighten() {
    for (uint32_t c = 0; c < corners_.size(); ++c)  // rows that end at this corner
      for (const Wall& wall : walls_[c])
        if (wall.next == no_corner) follow(c, wall.to);
    for (uint32_t c = 0; c < corners_.size(); ++c)  // closed rows, from their lowest corner
      for (const Wall& wall : walls_[c]) follow(c, wall.to);
    for (uint32_t c = 0; c < corners_.size(); ++c)
      if (const auto place = out_.moved.find(corners_[c]); place != out_.moved.end())
        out_.farthest_m = std::max(out_.farthest_m, glm::distance(place->first, place->second));
    return std::move(out_);
  }

 private:
  struct Wall {
    uint32_t to;
    uint32_t next;  // the corner at the far end of the wall that continues this one, or none
  };

  uint32_t number(const dvec2& p) const {
    return static_cast<uint32_t>(std::lower_bound(corners_.begin(), corners_.end(), p, LessPoint()) - corners_.begin());
  }

  void pair_up(uint32_t c) {
    struct Pair {
      double off_m;
      size_t a, b;
    };
    std::vector<Pair> pairs;
    auto& walls = walls_[c];
    for (size_t a = 0; a < walls.size(); ++a) {
      for (size_t b = a + 1; b < walls.size(); ++b) {
        const dvec2 &p = corners_[walls[a].to], &q = corners_[walls[b].to];
        if (glm::dot(p - corners_[c], q - corners_[c]) >= 0) continue;
        const double off_m = distance_from_line(corners_[c], p, q);
        if (off_m <= tolerance_m_) pairs.push_back({off_m, a, b});
      }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.off_m < y.off_m; });
    for (const Pair& pair : pairs) {
      if (walls[pair.a].next != no_corner || walls[pair.b].next != no_corner) continue;
      walls[pair.a].next = walls[pair.b].to;
      walls[pair.b].next = walls[pair.a].to;
    }
  }

  // Collects the row that begins with a wall, once, and straightens it.
  void follow(uint32_t from, uint32_t to) {
    if (done_.contains({from, to})) return;
    std::vector<uint32_t> row{from};
    while (to != no_corner && done_.insert({from, to}).second) {
      done_.insert({to, from});
      row.push_back(to);
      const auto& walls = walls_[to];
      const auto back = std::find_if(walls.begin(), walls.end(), [&](const Wall& w) { return w.to == from; });
      from = std::exchange(to, back->next);
    }
    divide(row, 0, row.size() - 1);
  }

  void divide(const std::vector<uint32_t>& row, size_t first, size_t last) {
    std::vector<std::pair<size_t, size_t>> parts{{first, last}};
    while (!parts.empty()) {
      const auto [a, b] = parts.back();
      parts.pop_back();
      if (b < a + 2) continue;
      const dvec2 &p = corners_[row[a]], &q = corners_[row[b]];
      size_t farthest = a + 1;
      double most_m = 0;
      for (size_t i = a + 1; i < b; ++i) {
        const double off_m = p == q ? glm::distance(p, corners_[row[i]]) : distance_from_line(corners_[row[i]], p, q);
        if (off_m > most_m) std::tie(farthest, most_m) = std::pair(i, off_m);
      }
      if (most_m > tolerance_m_ || p == q) {
        parts.emplace_back(a, farthest);
        parts.emplace_back(farthest, b);
        continue;
      }
      const dvec2 along = glm::normalize(q - p);
      for (size_t i = a + 1; i < b; ++i) {
        const dvec2 &corner = corners_[row[i]], place = p + along * glm::dot(along, corner - p);
        if (glm::distance(corner, place) > least_move_m) out_.moved.try_emplace(corner, place);
      }
    }
  }

  double tolerance_m_;
  std::vector<dvec2> corners_;            // sorted
  std::vector<std::vector<Wall>> walls_;  // walls of each corner, sorted by the number of the other corner
  std::set<std::pair<uint32_t, uint32_t>> done_;
  StraightWalls out_;
};

}  // namespace

Polygon StraightWalls::polygon_of(const Footprint& footprint, const glm::dvec2& shift) const {
  const auto ring = [&](RingM points) {
    for (glm::dvec2& p : points) {
      const auto place = moved.find(p);
      p = (place == moved.end() ? p : place->second) + shift;
    }
    return make_ring(points);
  };
  Polygon polygon{ring(footprint.outer), {}};
  for (const RingM& hole : footprint.holes) polygon.holes.push_back(ring(hole));
  return polygon;
}

StraightWalls straight_walls(std::span<const Footprint> footprints, double rounding_m) {
  constexpr double roundings = 2.5;
  return rounding_m > 0 ? WallGraph(footprints, roundings * rounding_m).straighten() : StraightWalls{};
}

double rounding_of(std::span<const Footprint> footprints, std::span<const double> steps) {
  for (const double step : steps) {
    bool all = true;
    each_ring(footprints, [&](const RingM& ring) {
      for (const dvec2& p : ring)
        for (const double x : {p.x, p.y}) all = all && std::abs(x / step - std::round(x / step)) < 1e-3;
    });
    if (all) return step / 2;
  }
  return 0;
}

}  // namespace wavetracer::imports
