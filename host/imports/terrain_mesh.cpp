// SPDX-License-Identifier: Apache-2.0
// Stores half-edges: edge e goes from corners_[e] to the next corner of its triangle, twins_[e] is the same edge of the
// neighbouring triangle. Coordinates are below 2^14, so that tests of sides and circles are exact in 64 bits.
#include "imports/terrain_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace wavetracer::imports {
namespace {

constexpr int32_t no_edge = -1;

// Returns a positive number if c is left of a -> b.
int64_t side(const GridPost& a, const GridPost& b, const GridPost& c) {
  return int64_t{b.column - a.column} * (c.row - a.row) - int64_t{b.row - a.row} * (c.column - a.column);
}

// Tells whether p is inside the circle through a, b and c, which are counter-clockwise.
bool in_circle(const GridPost& a, const GridPost& b, const GridPost& c, const GridPost& p) {
  const int64_t ax = a.column - p.column, ay = a.row - p.row, bx = b.column - p.column, by = b.row - p.row,
                cx = c.column - p.column, cy = c.row - p.row;
  const int64_t a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return ax * (by * c2 - b2 * cy) - ay * (bx * c2 - b2 * cx) + a2 * (bx * cy - by * cx) > 0;
}

// Calls visit(post, height of the plane there) for all posts in the triangle, including its border.
template <class Visit>
void visit_posts(const std::array<GridPost, 3>& t, const std::array<double, 3>& heights, const Visit& visit) {
  const int64_t area = side(t[0], t[1], t[2]);
  const auto [low_c, high_c] = std::minmax({t[0].column, t[1].column, t[2].column});
  const auto [low_r, high_r] = std::minmax({t[0].row, t[1].row, t[2].row});
  for (int32_t row = low_r; row <= high_r; ++row) {
    bool met = false;
    for (int32_t column = low_c; column <= high_c; ++column) {
      const GridPost p{column, row};
      const int64_t w0 = side(t[1], t[2], p), w1 = side(t[2], t[0], p), w2 = area - w0 - w1;
      if (w0 < 0 || w1 < 0 || w2 < 0) {
        if (met) break;  // the posts of a row in a triangle are consecutive
        continue;
      }
      met = true;
      visit(p, (static_cast<double>(w0) * heights[0] + static_cast<double>(w1) * heights[1] +
                static_cast<double>(w2) * heights[2]) /
                   static_cast<double>(area));
    }
  }
}

class Mesher {
 public:
  Mesher(int32_t columns, int32_t rows, std::span<const float> heights_m) : columns_(columns), heights_m_(heights_m) {
    posts_ = {{0, 0}, {columns - 1, 0}, {columns - 1, rows - 1}, {0, rows - 1}};
    const int32_t first = put(0, 1, 2, no_edge, no_edge, no_edge);
    put(0, 2, 3, first + 2, no_edge, no_edge);
    measure_new();
  }

  TerrainMesh run(double error_m) {
    while (!worst_.empty()) {
      const Worst worst = worst_.top();
      worst_.pop();
      const auto t = static_cast<size_t>(worst.triangle);
      if (worst.version != versions_[t]) continue;  // it belongs to a triangle that was replaced
      if (!(worst.error_m > error_m)) break;
      add(worst.triangle, candidates_[t]);
      measure_new();
    }
    TerrainMesh out{std::move(posts_), {}};
    for (size_t e = 0; e < corners_.size(); e += 3)
      out.triangles.push_back({corners_[e], corners_[e + 1], corners_[e + 2]});
    return out;
  }

 private:
  struct Worst {
    double error_m;
    int32_t triangle;
    uint32_t version;
    bool operator<(const Worst& o) const { return error_m != o.error_m ? error_m < o.error_m : triangle > o.triangle; }
  };

  double height(const GridPost& p) const {
    return heights_m_[static_cast<size_t>(p.row) * static_cast<size_t>(columns_) + static_cast<size_t>(p.column)];
  }
  const GridPost& post(int32_t edge) const { return posts_[corners_[static_cast<size_t>(edge)]]; }
  uint32_t corner(int32_t edge) const { return corners_[static_cast<size_t>(edge)]; }
  int32_t twin(int32_t edge) const { return twins_[static_cast<size_t>(edge)]; }
  static int32_t next(int32_t e) { return e % 3 == 2 ? e - 2 : e + 1; }

  // Stores a triangle with the twins of its edges ab, bc and ca, at `edge` in place of another triangle, or at the end.
  int32_t put(uint32_t a, uint32_t b, uint32_t c, int32_t ab, int32_t bc, int32_t ca, int32_t edge = no_edge) {
    if (edge == no_edge) {
      edge = static_cast<int32_t>(corners_.size());
      corners_.resize(corners_.size() + 3);
      twins_.resize(twins_.size() + 3);
      candidates_.emplace_back();
      versions_.push_back(0);
    }
    const auto e = static_cast<size_t>(edge);
    corners_[e] = a, corners_[e + 1] = b, corners_[e + 2] = c;
    const std::array<int32_t, 3> others = {ab, bc, ca};
    for (size_t k = 0; k < 3; ++k) {
      twins_[e + k] = others[k];
      if (others[k] != no_edge) twins_[static_cast<size_t>(others[k])] = edge + static_cast<int32_t>(k);
    }
    ++versions_[e / 3];
    new_.push_back(edge / 3);
    return edge;
  }

  void measure_new() {
    std::sort(new_.begin(), new_.end());
    new_.erase(std::unique(new_.begin(), new_.end()), new_.end());
    for (const int32_t t : new_) measure(t);
    new_.clear();
  }

  void measure(int32_t t) {
    const std::array<GridPost, 3> corners = {post(3 * t), post(3 * t + 1), post(3 * t + 2)};
    double most = 0;
    visit_posts(corners, {height(corners[0]), height(corners[1]), height(corners[2])},
                [&](const GridPost& p, double plane) {
                  const double error = std::abs(plane - height(p));
                  if (error <= most || std::ranges::find(corners, p) != corners.end()) return;
                  most = error;
                  candidates_[static_cast<size_t>(t)] = p;
                });
    if (most > 0) worst_.push({most, t, versions_[static_cast<size_t>(t)]});
  }

  void add(int32_t t, const GridPost& p) {
    const auto added = static_cast<uint32_t>(posts_.size());
    posts_.push_back(p);
    const int32_t e = 3 * t;
    for (int32_t k = 0; k < 3; ++k)
      if (side(post(e + k), post(next(e + k)), p) == 0) return split_edge(e + k, added);
    const uint32_t a = corner(e), b = corner(e + 1), c = corner(e + 2);
    const int32_t ab = twin(e), bc = twin(e + 1), ca = twin(e + 2);
    const int32_t t0 = put(a, b, added, ab, no_edge, no_edge, e);
    const int32_t t1 = put(b, c, added, bc, no_edge, t0 + 1);
    const int32_t t2 = put(c, a, added, ca, t0 + 2, t1 + 1);
    for (const int32_t outer : {t0, t1, t2}) legalize(outer);
  }

  // Splits edge e, between two triangles or at the border, at a post that lies on it.
  void split_edge(int32_t e, uint32_t added) {
    const int32_t bc = next(e), ca = next(bc), other = twin(e);
    const uint32_t a = corner(e), b = corner(bc), c = corner(ca);
    const int32_t twin_bc = twin(bc), twin_ca = twin(ca);
    // The edges of the neighbouring triangle, read before anything changes.
    const int32_t ad = other == no_edge ? no_edge : next(other), db = other == no_edge ? no_edge : next(ad);
    const uint32_t d = other == no_edge ? 0 : corner(db);
    const int32_t twin_ad = other == no_edge ? no_edge : twin(ad), twin_db = other == no_edge ? no_edge : twin(db);
    const int32_t t0 = put(c, a, added, twin_ca, no_edge, no_edge, e - e % 3);
    const int32_t t1 = put(b, c, added, twin_bc, t0 + 2, no_edge);
    if (other == no_edge) {
      legalize(t0);
      legalize(t1);
      return;
    }
    const int32_t t2 = put(a, d, added, twin_ad, no_edge, t0 + 1, other - other % 3);
    const int32_t t3 = put(d, b, added, twin_db, t1 + 2, t2 + 1);
    for (const int32_t outer : {t0, t1, t2, t3}) legalize(outer);
  }

  // Flips the edge in its quadrilateral if Delaunay's condition requires that; then checks the edges behind it.
  void legalize(int32_t first) {
    std::vector<int32_t> edges = {first};
    while (!edges.empty()) {
      const int32_t e = edges.back(), other = twin(e);
      edges.pop_back();
      if (other == no_edge) continue;
      // e goes from a to b, with c opposite; the twin goes from b to a, with d opposite.
      const int32_t bc = next(e), ca = next(bc), ad = next(other), db = next(ad);
      if (!in_circle(post(e), post(bc), post(ca), post(db))) continue;
      const uint32_t a = corner(e), b = corner(bc), c = corner(ca), d = corner(db);
      const int32_t twin_bc = twin(bc), twin_ca = twin(ca), twin_ad = twin(ad), twin_db = twin(db);
      const int32_t t0 = put(a, d, c, twin_ad, no_edge, twin_ca, e - e % 3);
      const int32_t t1 = put(d, b, c, twin_db, twin_bc, t0 + 1, other - other % 3);
      edges.push_back(t0);
      edges.push_back(t1);
    }
  }

  int32_t columns_;
  std::span<const float> heights_m_;
  std::vector<GridPost> posts_;
  std::vector<uint32_t> corners_;     // three for each triangle
  std::vector<int32_t> twins_;        // one for each edge
  std::vector<GridPost> candidates_;  // for each triangle, the post with the largest error
  std::vector<uint32_t> versions_;    // for each triangle, how often it was replaced
  std::vector<int32_t> new_;          // triangles that must still be measured
  std::priority_queue<Worst> worst_;
};

}  // namespace

TerrainMesh mesh_terrain(int32_t columns, int32_t rows, std::span<const float> heights_m, double error_m) {
  return Mesher(columns, rows, heights_m).run(error_m);
}

TerrainError terrain_error(const TerrainMesh& mesh, int32_t columns, std::span<const float> heights_m) {
  std::vector<float> errors(heights_m.size(), 0);
  const auto place = [&](const GridPost& p) {
    return static_cast<size_t>(p.row) * static_cast<size_t>(columns) + static_cast<size_t>(p.column);
  };
  for (const Triangle& t : mesh.triangles) {
    const std::array<GridPost, 3> corners = {mesh.posts[t[0]], mesh.posts[t[1]], mesh.posts[t[2]]};
    std::array<double, 3> heights{};
    for (size_t k = 0; k < 3; ++k) heights[k] = heights_m[place(corners[k])];
    visit_posts(corners, heights, [&](const GridPost& p, double plane) {
      errors[place(p)] = static_cast<float>(std::abs(plane - heights_m[place(p)]));
    });
  }
  TerrainError out;
  double squares = 0;
  for (const float error : errors) {
    out.largest_m = std::max(out.largest_m, static_cast<double>(error));
    squares += static_cast<double>(error) * error;
  }
  out.rms_m = std::sqrt(squares / static_cast<double>(errors.size()));
  return out;
}

}  // namespace wavetracer::imports
