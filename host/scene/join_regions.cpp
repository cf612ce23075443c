// SPDX-License-Identifier: Apache-2.0
// A queue orders pairs by the root mean square of the heights over their common plane, which follows from sums alone;
// only when a pair is taken from it are the tolerances of all vertices checked.
#include "scene/region_steps.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <queue>
#include <tuple>

namespace wavetracer {
namespace {

class RegionJoiner {
 public:
  RegionJoiner(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions)
      : mesh_(mesh),
        scene_(mesh.scene),
        neighbours_(neighbours),
        regions_(regions),
        beside_(regions.size()),
        version_(regions.size(), 0),
        parent_(regions.size()) {
    most_m_ = *std::max_element(mesh.tolerance_m.begin(), mesh.tolerance_m.end());
    for (uint32_t r = 0; r < regions.size(); ++r) parent_[r] = r;
  }

  void join() {
    find_pairs();
    while (!queue_.empty()) {
      const Pair pair = queue_.top();
      queue_.pop();
      if (pair.version_a == version_[pair.a] && pair.version_b == version_[pair.b]) try_join(pair.a, pair.b);
    }
    std::vector<FlatRegion> kept;
    for (uint32_t r = 0; r < regions_.size(); ++r)
      if (parent_[r] == r) kept.push_back(std::move(regions_[r]));
    regions_ = std::move(kept);
  }

 private:
  struct Pair {
    double rms_m;
    uint32_t a, b, version_a, version_b;
    bool operator<(const Pair& other) const {  // the best one on top
      return std::tie(rms_m, a, b) > std::tie(other.rms_m, other.a, other.b);
    }
  };

  uint32_t root(uint32_t r) {
    while (parent_[r] != r) r = parent_[r] = parent_[parent_[r]];
    return r;
  }

  void find_pairs() {
    const std::vector<uint32_t> region_of = mesh_.region_of_triangle(regions_);
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (uint32_t t = 0; t < region_of.size(); ++t) {
      neighbours_.visit(t, [&](const FlatNeighbour& n) {
        const uint32_t a = region_of[t], b = region_of[n.other];
        if (a < b && may_join(a, b, n)) pairs.emplace_back(a, b);
      });
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    if (pairs.empty()) return;
    for (const FlatRegion& region : regions_) sums_.push_back(mesh_.sums(region.vertices));
    for (const auto& [a, b] : pairs) {
      beside_[a].push_back(b);
      beside_[b].push_back(a);
      push(a, b);
    }
  }

  bool may_join(uint32_t a, uint32_t b, const FlatNeighbour& n) const {
    const Plane &p = regions_[a].plane, &q = regions_[b].plane;
    if (std::abs(glm::dot(p.normal, q.normal)) < least_cosine || !neighbours_.unfolded(n, p.normal)) return false;
    return std::min(highest_m(n.other, p), highest_m(n.triangle, q)) <= 4 * most_m_;
  }
  double highest_m(uint32_t t, const Plane& plane) const {
    double out_m = 0;
    for (const uint32_t v : scene_.triangles[t])
      out_m = std::max(out_m, std::abs(height_over(plane, scene_.vertices[v])));
    return out_m;
  }

  void push(uint32_t a, uint32_t b) {
    if (a > b) std::swap(a, b);
    PlaneSums both = sums_[a];
    both.join(sums_[b]);
    if (const double rms_m = both.fit().rms_m; rms_m <= most_m_) queue_.push({rms_m, a, b, version_[a], version_[b]});
  }

  void try_join(uint32_t a, uint32_t b) {
    PlaneSums both = sums_[a];
    both.join(sums_[b]);
    const Plane nearly = both.fit().plane;  // shared vertices count twice
    if (!mesh_.are_near(regions_[b].vertices, nearly, 1.5) || !mesh_.are_near(regions_[a].vertices, nearly, 1.5))
      return;
    for (const uint32_t r : {a, b}) std::sort(regions_[r].vertices.begin(), regions_[r].vertices.end());
    std::vector<uint32_t> vertices;
    std::set_union(regions_[a].vertices.begin(), regions_[a].vertices.end(), regions_[b].vertices.begin(),
                   regions_[b].vertices.end(), std::back_inserter(vertices));
    const PlaneSums sums = mesh_.sums(vertices);
    const Plane plane = sums.fit().plane;
    if (!mesh_.are_near(vertices, plane)) return;
    FlatRegion &into = regions_[a], &from = regions_[b];
    into.triangles.insert(into.triangles.end(), from.triangles.begin(), from.triangles.end());
    into.vertices = std::move(vertices);
    into.plane = plane;
    into.exact = false;
    from = {};
    sums_[a] = sums;
    parent_[b] = a;
    ++version_[a];
    ++version_[b];
    beside_[a].insert(beside_[a].end(), beside_[b].begin(), beside_[b].end());
    for (uint32_t& r : beside_[a]) r = root(r);
    std::sort(beside_[a].begin(), beside_[a].end());
    beside_[a].erase(std::unique(beside_[a].begin(), beside_[a].end()), beside_[a].end());
    std::erase(beside_[a], a);
    for (const uint32_t r : beside_[a]) push(a, r);
  }

  const FlatMesh& mesh_;
  const Scene& scene_;
  const FlatNeighbours& neighbours_;
  std::vector<FlatRegion>& regions_;
  double most_m_ = 0;
  std::vector<PlaneSums> sums_;                // per region, set once it is in a pair
  std::vector<std::vector<uint32_t>> beside_;  // neighbours of each region
  std::vector<uint32_t> version_, parent_;
  std::priority_queue<Pair> queue_;
};

}  // namespace

void join_regions(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions) {
  if (!regions.empty()) RegionJoiner(mesh, neighbours, regions).join();
}

}  // namespace wavetracer
