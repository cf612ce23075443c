// SPDX-License-Identifier: Apache-2.0
// Triangles move in rounds, each computed from the state before it, so that the order of triangles does not matter. The
// difference of the heights over both planes tells where a triangle is: it changes its sign at their line, and noise
// hardly changes it.
#include "scene/region_steps.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/topology.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr int most_border_rounds = 50;

class Borders {
 public:
  Borders(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions)
      : mesh_(mesh),
        scene_(mesh.scene),
        neighbours_(neighbours),
        regions_(regions),
        region_of_(mesh.region_of_triangle(regions)) {
    for (const FlatRegion& region : regions) centres_.push_back(mesh.centre(region.vertices));
  }

  void straighten() {
    std::vector<bool> changed(regions_.size(), false);
    std::vector<uint32_t> active;  // triangles that may belong to a neighbour
    for (uint32_t r = 0; r < regions_.size(); ++r)
      if (!regions_[r].exact) active.insert(active.end(), regions_[r].triangles.begin(), regions_[r].triangles.end());
    for (int round = 0; round < most_border_rounds && !active.empty(); ++round) {
      std::vector<std::pair<uint32_t, uint32_t>> moves;  // triangle, region
      for (const uint32_t t : active) {
        if (regions_[region_of_[t]].exact) continue;
        if (const uint32_t better = better_for(t); better != region_of_[t]) moves.emplace_back(t, better);
      }
      active.clear();
      for (const auto& [t, r] : moves) {
        changed[region_of_[t]] = changed[r] = true;
        region_of_[t] = r;
        neighbours_.visit(t, [&](const FlatNeighbour& pair) { active.push_back(pair.other); });
      }
      std::sort(active.begin(), active.end());
      active.erase(std::unique(active.begin(), active.end()), active.end());
    }
    for (uint32_t r = 0; r < regions_.size(); ++r)
      if (changed[r]) regions_[r].triangles.clear();
    for (uint32_t t = 0; t < region_of_.size(); ++t)
      if (changed[region_of_[t]]) regions_[region_of_[t]].triangles.push_back(t);
    for (uint32_t r = 0; r < regions_.size(); ++r)
      if (changed[r]) renew(regions_[r]);
    std::erase_if(regions_, [](const FlatRegion& region) { return region.triangles.empty(); });
  }

 private:
  uint32_t better_for(uint32_t t) const {
    const uint32_t own = region_of_[t];
    uint32_t best = own;
    neighbours_.visit(t, [&](const FlatNeighbour& pair) {
      const uint32_t other = region_of_[pair.other];
      // If several are equal, the lowest.
      if (other == own || other >= best + (best == own ? regions_.size() : 0)) return;
      if (regions_[other].vertices.size() > 3 && neighbours_.unfolded(pair, regions_[own].plane.normal) &&
          fits(t, regions_[other]) && is_beyond(t, own, other))
        best = other;
    });
    return best;
  }

  bool fits(uint32_t t, const FlatRegion& region) const {
    if (!region.exact) return mesh_.are_near(scene_.triangles[t], region.plane);
    return triangle_is_near(scene_, t, region.plane, flat_as_it_is_m);
  }

  bool is_beyond(uint32_t t, uint32_t own, uint32_t other) const {
    const Plane& p = regions_[own].plane;
    Plane q = regions_[other].plane;
    if (const double cosine = glm::dot(p.normal, q.normal); std::abs(cosine) < least_cosine)
      return false;
    else if (cosine < 0)
      q = {-q.normal, -q.offset_m};
    const auto side = [&](const dvec3& at) { return height_over(p, at) - height_over(q, at); };
    const auto& [a, b, c] = scene_.triangles[t];
    const double here = side((scene_.vertices[a] + scene_.vertices[b] + scene_.vertices[c]) / 3.0);
    return here * side(centres_[own]) < 0 && here * side(centres_[other]) > 0;
  }

  // Sets the vertices of the triangles that a region has now, and the plane that fits them, unless the old plane fits
  // better.
  void renew(FlatRegion& region) const {
    region.vertices.clear();
    for (const uint32_t t : region.triangles)
      region.vertices.insert(region.vertices.end(), scene_.triangles[t].begin(), scene_.triangles[t].end());
    std::sort(region.vertices.begin(), region.vertices.end());
    region.vertices.erase(std::unique(region.vertices.begin(), region.vertices.end()), region.vertices.end());
    if (region.exact || region.vertices.empty()) return;
    const Plane plane = mesh_.sums(region.vertices).fit().plane;
    if (mesh_.are_near(region.vertices, plane)) region.plane = plane;
  }

  const FlatMesh& mesh_;
  const Scene& scene_;
  const FlatNeighbours& neighbours_;
  std::vector<FlatRegion>& regions_;
  std::vector<uint32_t> region_of_;
  std::vector<dvec3> centres_;
};

}  // namespace

void straighten_borders(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions) {
  Borders(mesh, neighbours, regions).straighten();
}

}  // namespace wavetracer
