// SPDX-License-Identifier: Apache-2.0
// A vertex takes the shortest move onto several planes by Gram and Schmidt: each step goes along the part of the next
// normal that is perpendicular to those before, so it leaves no plane that was reached.
#include "scene/flatten.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "scene/flat_regions.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
// Sine of the angle of a plane with all others at a vertex: a smaller one adds no direction.
constexpr double least_sine = 1e-6;
constexpr double on_plane_m = 1e-9;      // a vertex that is nearer than this is on the plane
constexpr double least_fit_sine = 1e-3;  // smaller angles count as this where planes are fitted together
constexpr int most_fits = 30;

class Flattener {
 public:
  Flattener(const FlatMesh& mesh, std::vector<FlatRegion> regions)
      : mesh_(mesh), scene_(mesh.scene), regions_(std::move(regions)) {
    list_planes();
  }

  Flattened flatten() {
    fit_together();
    Flattened out = move();
    while (give_up()) out = move();
    for (uint32_t r = 0; r < regions_.size(); ++r) {
      std::vector<uint32_t>& plane_of = regions_[r].exact ? out.exact_plane : out.triangle_plane;
      for (const uint32_t t : regions_[r].triangles) {
        if (has_lost(r, t))
          out.left_out += !regions_[r].exact;
        else
          plane_of[t] = static_cast<uint32_t>(out.planes.size());
      }
      out.planes.push_back(regions_[r].plane);
    }
    return out;
  }

 private:
  // Lists the regions of each vertex, exact ones first: the plane of an exact region is more than that of one triangle.
  void list_planes() {
    first_.assign(scene_.vertices.size() + 1, 0);
    for (int pass = 0; pass < 2; ++pass) {  // the first pass counts, the second one fills
      for (const bool exact : {true, false}) {
        for (uint32_t r = 0; r < regions_.size(); ++r) {
          if (regions_[r].exact != exact || regions_[r].vertices.size() <= 3) continue;
          for (const uint32_t v : regions_[r].vertices) {
            if (pass == 0)
              ++first_[v + 1];
            else
              planes_[first_[v] + filled_[v]++] = r;
          }
        }
      }
      if (pass > 0) return;
      for (size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
      planes_.resize(first_.back());
      filled_.assign(scene_.vertices.size(), 0);
    }
  }
  std::span<const uint32_t> planes_of(uint32_t v) const {
    return {planes_.data() + first_[v], planes_.data() + first_[v + 1]};
  }
  bool must_move(uint32_t v) const {
    return std::ranges::any_of(planes_of(v), [&](uint32_t r) { return !regions_[r].exact; });
  }

  // A point that is being moved onto planes.
  struct Place {
    dvec3 p;
    std::array<dvec3, 3> used;  // orthogonal unit vectors
    size_t count = 0;

    // Returns the part of a normal that is perpendicular to the used directions.
    dvec3 rest(dvec3 n) const {
      for (size_t k = 0; k < count; ++k) n -= glm::dot(n, used[k]) * used[k];
      return n;
    }
  };

  // Moves the point onto one more plane. Returns false, and does nothing, if the plane is parallel to those reached but
  // lies elsewhere.
  static bool step(Place& place, const Plane& plane) {
    const double height_m = height_over(plane, place.p);
    const dvec3 rest = place.rest(plane.normal);
    const double sine = glm::length(rest);
    if (place.count == 3 || sine < least_sine) return std::abs(height_m) <= on_plane_m;
    place.used[place.count++] = rest / sine;
    place.p -= height_m / sine * (rest / sine);
    return true;
  }

  // Returns the new position of a vertex. Calls left(region) for planes that it cannot reach within its tolerance.
  template <class Left>
  dvec3 place(uint32_t v, const Left& left) const {
    Place place{scene_.vertices[v], {}};
    for (const uint32_t r : planes_of(v)) {
      Place next = place;
      if (step(next, regions_[r].plane) && glm::distance(next.p, scene_.vertices[v]) <= mesh_.tolerance_m[v])
        place = next;
      else
        left(r);
    }
    return place.p;
  }

  // Moves all vertices, and notes which of them their regions have lost.
  Flattened move() {
    Flattened out;
    out.vertices = scene_.vertices;
    out.triangle_plane.assign(scene_.triangles.size(), no_plane);
    out.exact_plane.assign(scene_.triangles.size(), no_plane);
    lost_.assign(regions_.size(), {});
    for (uint32_t v = 0; v < scene_.vertices.size(); ++v) {
      if (!must_move(v)) continue;
      const dvec3 p = place(v, [&](uint32_t r) { lost_[r].push_back(v); });
      if (p == scene_.vertices[v]) continue;
      ++out.moved;
      out.farthest_m = std::max(out.farthest_m, glm::distance(p, scene_.vertices[v]));
      out.vertices[v] = p;
    }
    return out;
  }
  bool has_lost(uint32_t r, uint32_t t) const {
    return std::ranges::any_of(scene_.triangles[t],
                               [&](uint32_t v) { return std::ranges::binary_search(lost_[r], v); });
  }

  // Drops regions that have lost more than half of their triangles: they were no planes. Returns false if there are
  // none.
  bool give_up() {
    bool any = false;
    for (uint32_t r = 0; r < regions_.size(); ++r) {
      FlatRegion& region = regions_[r];
      if (region.exact || lost_[r].empty()) continue;
      const auto lost = std::ranges::count_if(region.triangles, [&](uint32_t t) { return has_lost(r, t); });
      if (2 * static_cast<size_t>(lost) <= region.triangles.size()) continue;
      region = {};
      any = true;
    }
    if (any) list_planes();
    return any;
  }

  // Fits planes anew at vertices that could not be put onto all their planes.
  void fit_together() {
    std::vector<uint32_t> shared;
    for (uint32_t v = 0; v < scene_.vertices.size(); ++v)
      if (planes_of(v).size() > 1 && must_move(v)) shared.push_back(v);
    for (int round = 0; round < most_fits; ++round) {
      std::vector<bool> again(regions_.size(), false);
      for (const uint32_t v : shared) {
        bool missed = false;
        place(v, [&](uint32_t) { missed = true; });
        for (const uint32_t r : planes_of(v))
          if (missed && !regions_[r].exact) again[r] = true;
      }
      bool any = false;
      for (uint32_t r = 0; r < regions_.size(); ++r)
        if (again[r]) any |= fit(r);
      if (!any) return;
    }
  }

  // Fits the plane of region r; each vertex is weighted by the square of its way to the plane, along the line or to the
  // point of its other planes. Returns false, and does nothing, if the new plane is too far from some vertex.
  bool fit(uint32_t r) {
    FlatRegion& region = regions_[r];
    PlaneSums sums(scene_.vertices[region.vertices[0]]);
    for (const uint32_t v : region.vertices) {
      Place place{scene_.vertices[v], {}};
      for (const uint32_t other : planes_of(v))
        if (other != r) step(place, regions_[other].plane);
      const double sine = std::max(glm::length(place.rest(region.plane.normal)), least_fit_sine);
      if (glm::distance(place.p, scene_.vertices[v]) <= mesh_.tolerance_m[v])
        sums.add(place.p, 1 / (sine * sine));
      else
        sums.add(scene_.vertices[v]);
    }
    const Plane plane = sums.fit().plane;
    if (!mesh_.are_near(region.vertices, plane)) return false;
    region.plane = plane;
    return true;
  }

  const FlatMesh& mesh_;
  const Scene& scene_;
  std::vector<FlatRegion> regions_;
  std::vector<uint32_t> first_, planes_, filled_;  // the regions of vertex v are in planes_, from first_[v] on
  std::vector<std::vector<uint32_t>> lost_;        // per region: vertices that are not on its plane, ascending
};

}  // namespace

Flattened flatten(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges,
                  std::span<const double> tolerance_m) {
  const FlatMesh mesh{scene, triangle_edges, tolerance_m};
  return Flattener(mesh, find_flat_regions(mesh)).flatten();
}

Flattened flatten_scene(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges, double tolerance_m,
                        std::span<const double> rounding_m) {
  std::vector<double> tolerances_m;
  for (const double rounding : rounding_m)
    tolerances_m.push_back(tolerance_m > 0 ? std::max(tolerance_m, 2 * rounding) : 0);
  Flattened flat = flatten(scene, triangle_edges, tolerances_m);
  scene.vertices = std::move(flat.vertices);
  LoadReport& report = scene.report;
  report.plane_tolerance_m = *std::max_element(tolerances_m.begin(), tolerances_m.end());
  report.flattened_vertices = flat.moved;
  report.flattened_by_m = flat.farthest_m;
  report.bent_triangles = flat.left_out;
  if (flat.farthest_m > tolerance_m)
    report.warnings.push_back(fmt::format(
        "the coordinates of the scene are as coarse as {:.2g} mm, so {} vertices were moved by up to {:.2g} mm "
        "onto the planes of their surfaces: save the scene nearer to its origin, or with double coordinates",
        report.plane_tolerance_m * 1000, flat.moved, flat.farthest_m * 1000));
  return flat;
}

}  // namespace wavetracer
