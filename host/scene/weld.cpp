// SPDX-License-Identifier: Apache-2.0
// Welds with a hash grid of cells four tolerances wide: each vertex looks into the cells within one tolerance of it,
// 3.4 on average, so that no pair is split by a border. Groups are kept in a forest. Cells as small as a tolerance,
// over a scene of kilometres, are too many for a SceneGrid, which has all of its cells in memory.
#include "scene/weld.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/forest.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t no_vertex = 0xFFFFFFFFu;

uint64_t mix(uint64_t x) {  // the finalizer of splitmix64 (Steele, Lea and Flood 2014)
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

// Chains of distinct positions, one per hash bucket. Different cells may share a bucket: distances decide, not keys.
class Grid {
 public:
  Grid(std::span<const glm::dvec3> vertices, double tolerance_m)
      : vertices_(vertices),
        tolerance_m_(tolerance_m),
        cell_m_(4 * tolerance_m),
        head_(std::bit_ceil(vertices.size() * 2 + 1), no_vertex),
        next_(vertices.size(), no_vertex) {}

  // Joins vertex i with all earlier ones within the tolerance, then adds it unless its exact position is there already.
  void add(uint32_t i, Forest& forest) {
    const glm::dvec3 p = vertices_[i];
    std::array<int64_t, 3> low, high;
    const double reach = tolerance_m_ * (1 + 1e-6) + 1e-12 * glm::length(p);  // allows for the rounding of p - reach
    for (int k = 0; k < 3; ++k) {
      low[static_cast<size_t>(k)] = cell(p[k] - reach);
      high[static_cast<size_t>(k)] = cell(p[k] + reach);
    }
    bool known = false;
    for (int64_t x = low[0]; x <= high[0]; ++x) {
      for (int64_t y = low[1]; y <= high[1]; ++y) {
        for (int64_t z = low[2]; z <= high[2]; ++z) known |= join_chain(head_[bucket(x, y, z)], i, forest);
      }
    }
    if (known) return;
    uint32_t& head = head_[bucket(cell(p.x), cell(p.y), cell(p.z))];
    next_[i] = head;
    head = i;
  }

 private:
  int64_t cell(double x) const { return static_cast<int64_t>(std::floor(x / cell_m_)); }
  size_t bucket(int64_t x, int64_t y, int64_t z) const {
    const uint64_t h = mix(static_cast<uint64_t>(x) + mix(static_cast<uint64_t>(y) + mix(static_cast<uint64_t>(z))));
    return static_cast<size_t>(h & (head_.size() - 1));
  }
  // Returns true if the chain holds the exact position of i.
  bool join_chain(uint32_t j, uint32_t i, Forest& forest) const {
    for (; j != no_vertex; j = next_[j]) {
      const glm::dvec3 d = vertices_[j] - vertices_[i];
      if (glm::dot(d, d) > tolerance_m_ * tolerance_m_) continue;
      forest.join(i, j);
      if (d == glm::dvec3(0)) return true;
    }
    return false;
  }

  std::span<const glm::dvec3> vertices_;
  double tolerance_m_, cell_m_;
  std::vector<uint32_t> head_, next_;
};

}  // namespace

Weld weld_vertices(std::span<const glm::dvec3> vertices, double tolerance_m) {
  Forest forest(vertices.size());
  Grid grid(vertices, tolerance_m);
  for (uint32_t i = 0; i < vertices.size(); ++i) grid.add(i, forest);
  Weld weld;
  weld.vertex.resize(vertices.size());
  for (uint32_t i = 0; i < vertices.size(); ++i) {
    const uint32_t root = forest.root(i);
    if (root == i) {
      weld.vertex[i] = static_cast<uint32_t>(weld.positions.size());
      weld.positions.push_back(vertices[i]);
    } else {
      weld.vertex[i] = weld.vertex[root];  // the root is lower, so its entry is set already
      weld.widest_m = std::max(weld.widest_m, glm::distance(vertices[i], vertices[root]));
    }
  }
  return weld;
}

std::vector<uint32_t> drop_unused_vertices(Scene& scene) {
  constexpr uint32_t unused = 0xFFFFFFFFu;
  std::vector<uint32_t> moved(scene.vertices.size(), unused), former;
  for (const auto& t : scene.triangles) {
    for (const uint32_t v : t) moved[v] = 0;
  }
  for (uint32_t v = 0; v < moved.size(); ++v) {
    if (moved[v] == unused) continue;
    moved[v] = static_cast<uint32_t>(former.size());
    scene.vertices[former.size()] = scene.vertices[v];
    former.push_back(v);
  }
  scene.vertices.resize(former.size());
  for (auto& t : scene.triangles) {
    for (uint32_t& v : t) v = moved[v];
  }
  return former;
}

}  // namespace wavetracer
