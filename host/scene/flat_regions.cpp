// SPDX-License-Identifier: Apache-2.0
// A region grows in rounds. Each round adds triangles that lie within the tolerance of the current plane and not much
// farther away than the region is wide, since the plane of a small triangle says little about far places; then the
// plane is fitted anew.
#include "scene/flat_regions.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "scene/flat_mesh.hpp"
#include "scene/region_steps.hpp"
#include "scene/topology.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr uint32_t no_region = 0xFFFFFFFFu;
constexpr int most_rounds = 100;  // about 20 are enough for a million triangles
// Rounds in which triangles were removed again; after more of them the surface counts as curved.
constexpr int most_retreats = 8;

class RegionGrower {
 public:
  RegionGrower(const FlatMesh& mesh, const FlatNeighbours& neighbours)
      : mesh_(mesh),
        scene_(mesh.scene),
        neighbours_(neighbours),
        region_of_(scene_.triangles.size(), no_region),
        banned_from_(scene_.triangles.size(), no_region),
        has_vertex_(scene_.vertices.size(), no_region) {
    shapes_.reserve(scene_.triangles.size());
    for (uint32_t t = 0; t < scene_.triangles.size(); ++t) shapes_.push_back(triangle_shape(scene_, t));
  }

  std::vector<FlatRegion> grow() {
    for (const uint32_t seed : largest_first(scene_, shapes_)) {
      if (region_of_[seed] == no_region) grow_from(seed);
    }
    return std::move(regions_);
  }

 private:
  void grow_from(uint32_t seed) {
    current_ = static_cast<uint32_t>(regions_.size());
    FlatRegion& region = regions_.emplace_back();
    const dvec3 normal = oriented(shapes_[seed].normal);
    region.plane = {normal, glm::dot(normal, scene_.vertices[scene_.triangles[seed][0]])};
    take(seed);
    for (size_t i = 0; i < region.triangles.size(); ++i) {
      neighbours_.visit(region.triangles[i], [&](const FlatNeighbour& pair) {
        if (region_of_[pair.other] == no_region && lies_in_plane(scene_, pair.other, shapes_[pair.other], region.plane))
          take(pair.other);
      });
    }
    gather_vertices(0);
    const FlatRegion exact = region;
    if (grow_fitted()) return;
    for (const uint32_t t : region.triangles) region_of_[t] = no_region;
    region = exact;
    for (const uint32_t t : region.triangles) region_of_[t] = current_;
  }

  void take(uint32_t t) {
    region_of_[t] = current_;
    regions_.back().triangles.push_back(t);
  }

  // Adds the vertices of the region's triangles from index `first` on.
  void gather_vertices(size_t first) {
    FlatRegion& region = regions_.back();
    for (size_t i = first; i < region.triangles.size(); ++i) {
      for (const uint32_t v : scene_.triangles[region.triangles[i]]) {
        if (has_vertex_[v] == current_) continue;
        has_vertex_[v] = current_;
        region.vertices.push_back(v);
      }
    }
  }

  // Returns false if the plane has left the seed; the region must then be dropped.
  bool grow_fitted() {
    FlatRegion& region = regions_.back();
    int retreats = 0;
    for (int round = 0;; ++round) {
      const size_t before = region.triangles.size();
      if (round > 0) {
        region.exact = false;
        region.plane = mesh_.sums(region.vertices).fit().plane;
        if (drop_strays()) {
          if (region.triangles.empty()) return false;
          ++retreats;
          continue;
        }
      }
      if (round > most_rounds || retreats > most_retreats) return true;
      if (!extend(2 * radius_m()) && !extend(std::numeric_limits<double>::infinity())) return true;
      gather_vertices(before);
    }
  }

  dvec3 centre() const { return mesh_.centre(regions_.back().vertices); }
  double radius_m() const {
    const dvec3 middle = centre();
    double out_m = 0;
    for (const uint32_t v : regions_.back().vertices)
      out_m = std::max(out_m, glm::distance(middle, scene_.vertices[v]));
    return out_m;
  }

  // Adds triangles that fit, are connected, and are within reach of the centre. Returns false if there are none.
  bool extend(double reach_m) {
    FlatRegion& region = regions_.back();
    const dvec3 middle = centre();
    const size_t before = region.triangles.size();
    for (size_t i = 0; i < region.triangles.size(); ++i) {
      neighbours_.visit(region.triangles[i], [&](const FlatNeighbour& pair) {
        if (region_of_[pair.other] != no_region || banned_from_[pair.other] == current_) return;
        if (!belongs(pair, region.plane)) return;
        for (const uint32_t v : scene_.triangles[pair.other])
          if (glm::distance(middle, scene_.vertices[v]) > reach_m) return;
        take(pair.other);
      });
    }
    return region.triangles.size() > before;
  }

  bool belongs(const FlatNeighbour& pair, const Plane& plane) const {
    const auto& corners = scene_.triangles[pair.other];
    if (!mesh_.are_near(corners, plane)) return false;
    if (std::ranges::all_of(corners, [&](uint32_t v) { return has_vertex_[v] == current_; })) return true;
    return std::abs(glm::dot(shapes_[pair.other].normal, plane.normal)) >= least_cosine &&
           neighbours_.unfolded(pair, plane.normal);
  }

  // Removes, for good, triangles with a corner that the new plane has left, and triangles that were connected only
  // through them. Returns false if there are none. If the seed is removed, so are all others.
  bool drop_strays() {
    FlatRegion& region = regions_.back();
    bool any = false;
    for (const uint32_t t : region.triangles) {
      if (mesh_.are_near(scene_.triangles[t], region.plane)) continue;
      banned_from_[t] = current_;
      any = true;
    }
    if (!any) return false;
    const uint32_t seed = region.triangles[0];
    for (const uint32_t t : region.triangles) region_of_[t] = no_region;
    for (const uint32_t v : region.vertices) has_vertex_[v] = no_region;
    std::vector<uint32_t> was = std::move(region.triangles);
    region.triangles.clear();
    region.vertices.clear();
    if (banned_from_[seed] == current_) return true;
    std::sort(was.begin(), was.end());
    take(seed);
    for (size_t i = 0; i < region.triangles.size(); ++i) {
      neighbours_.visit(region.triangles[i], [&](const FlatNeighbour& pair) {
        if (region_of_[pair.other] == no_region && banned_from_[pair.other] != current_ &&
            std::binary_search(was.begin(), was.end(), pair.other))
          take(pair.other);
      });
    }
    gather_vertices(0);
    return true;
  }

  const FlatMesh& mesh_;
  const Scene& scene_;
  const FlatNeighbours& neighbours_;
  std::vector<TriangleShape> shapes_;
  std::vector<uint32_t> region_of_;
  std::vector<uint32_t> banned_from_;  // per triangle: the last region that it was removed from
  std::vector<uint32_t> has_vertex_;   // per vertex: the last region that had it
  std::vector<FlatRegion> regions_;
  uint32_t current_ = 0;
};

}  // namespace

std::vector<FlatRegion> find_flat_regions(const FlatMesh& mesh) {
  const FlatNeighbours neighbours(mesh.scene, mesh.triangle_edges);
  std::vector<FlatRegion> regions = RegionGrower(mesh, neighbours).grow();
  join_regions(mesh, neighbours, regions);
  straighten_borders(mesh, neighbours, regions);
  give_back_curved(mesh, neighbours, regions);
  return regions;
}

}  // namespace wavetracer
