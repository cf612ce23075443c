// SPDX-License-Identifier: Apache-2.0
// For each triangle, the list of those that cover it is made from the pairs; the uncovered pieces then replace the
// triangle.
#include "scene/covered_faces.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "scene/body_sides.hpp"
#include "scene/build_scene.hpp"
#include "scene/coplanar_pairs.hpp"
#include "scene/cover_cut.hpp"
#include "scene/cover_order.hpp"
#include "scene/scene_warnings.hpp"
#include "scene/topology.hpp"
#include "scene/weld.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
using CoveredPair = std::pair<uint32_t, uint32_t>;  // the covered triangle, the one that covers it

// Rounding moves a point that several triangles share by less than this; welding moves points much farther.
constexpr double same_point_m = 1e-6;

struct PieceOfTriangle {
  uint32_t triangle;
  ConvexPolygon polygon;
};

ConvexPolygon polygon_of(const Scene& scene, uint32_t t) {
  ConvexPolygon out;
  for (const uint32_t v : scene.triangles[t]) out.push_back(scene.vertices[v]);
  return out;
}

class FaceCovering {
 public:
  FaceCovering(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges, std::vector<CoveredPair> pairs)
      : scene_(scene), triangle_edges_(triangle_edges), pairs_(std::move(pairs)) {
    const CoverOrder order(scene, triangle_edges);
    for (auto& [covered, cover] : pairs_) {
      if (order.covers(scene.triangle_surface[covered], scene.triangle_surface[cover])) std::swap(covered, cover);
      equally_large_.push_back(order.equally_large(scene.triangle_surface[covered], scene.triangle_surface[cover]));
    }
    share_planes(scene, order, pairs_);
  }

  void cut() {
    note_places();
    std::ranges::sort(pairs_);
    std::vector<bool> is_covered(scene_.triangles.size(), false);
    for (size_t i = 0; i < pairs_.size();) {
      const uint32_t t = pairs_[i].first;
      std::vector<CoverTriangle> covers;
      for (; i < pairs_.size() && pairs_[i].first == t; ++i)
        covers.push_back(cover_triangle(scene_, triangle_edges_, pairs_[i].second, normal_of(t)));
      is_covered[t] = true;
      scene_.report.covered_m2 += triangle_shape(scene_, t).area_m2;
      for (ConvexPolygon& part : uncovered_parts(polygon_of(scene_, t), covers)) {
        scene_.report.covered_m2 -= polygon_area_m2(part);
        pieces_.push_back({t, std::move(part)});
      }
    }
    replace(is_covered);
  }

 private:
  const dvec3& normal_of(uint32_t t) const { return scene_.surfaces[scene_.triangle_surface[t]].normal; }

  void note_places() {
    SharedPlaces places;
    BodySides bodies(scene_, triangle_edges_);
    for (size_t i = 0; i < pairs_.size(); ++i) {
      const auto& [covered, cover] = pairs_[i];
      const uint32_t below = scene_.triangle_surface[covered], above = scene_.triangle_surface[cover];
      if (bodies.hidden_between(below, above)) continue;
      const double area_m2 = polygon_area_m2(covered_part(
          polygon_of(scene_, covered), cover_triangle(scene_, triangle_edges_, cover, normal_of(covered))));
      if (area_m2 > 0)
        places.add(scene_.surfaces[above].material, scene_.surfaces[below].material, equally_large_[i], area_m2);
    }
    for (std::string& warning : places.warnings(scene_)) scene_.report.warnings.push_back(std::move(warning));
  }

  // Returns the vertex of every corner of the pieces: an existing one of their own surface, or else a new one. A
  // covering surface shares no vertex with the surface that is cut, so the ground and the houses on it stay separate
  // bodies.
  std::vector<uint32_t> find_vertices() {
    std::vector<size_t> first_corner, by_surface;
    for (size_t i = 0, corner = 0; i < pieces_.size(); corner += pieces_[i++].polygon.size()) {
      first_corner.push_back(corner);
      by_surface.push_back(i);
    }
    const auto surface_of = [&](size_t i) { return scene_.triangle_surface[pieces_[i].triangle]; };
    std::ranges::stable_sort(by_surface, {}, surface_of);
    std::vector<uint32_t> out(pieces_.empty() ? 0 : first_corner.back() + pieces_.back().polygon.size());
    for (size_t i = 0; i < by_surface.size();) {
      size_t end = i;
      while (end < by_surface.size() && surface_of(by_surface[end]) == surface_of(by_surface[i])) ++end;
      find_vertices_of(std::span(by_surface).subspan(i, end - i), first_corner, out);
      i = end;
    }
    return out;
  }

  // Does the same for the pieces of one surface.
  void find_vertices_of(std::span<const size_t> pieces, std::span<const size_t> first_corner,
                        std::vector<uint32_t>& out) {
    std::vector<uint32_t> known;
    for (const size_t i : pieces) {
      const auto& corners = scene_.triangles[pieces_[i].triangle];
      known.insert(known.end(), corners.begin(), corners.end());
    }
    std::ranges::sort(known);
    const auto repeated = std::ranges::unique(known);
    known.erase(repeated.begin(), repeated.end());
    std::vector<dvec3> points;
    std::vector<size_t> corner_of;  // for each point after the known ones, its place in out
    for (const uint32_t v : known) points.push_back(scene_.vertices[v]);
    for (const size_t i : pieces)
      for (size_t k = 0; k < pieces_[i].polygon.size(); ++k) {
        points.push_back(pieces_[i].polygon[k]);
        corner_of.push_back(first_corner[i] + k);
      }
    const Weld weld = weld_vertices(points, same_point_m);
    constexpr uint32_t unplaced = 0xFFFFFFFFu;
    std::vector<uint32_t> vertex_of(weld.positions.size(), unplaced);
    for (size_t i = 0; i < points.size(); ++i) {
      uint32_t& vertex = vertex_of[weld.vertex[i]];
      if (i < known.size()) {
        if (vertex == unplaced) vertex = known[i];
        continue;
      }
      if (vertex == unplaced) {
        vertex = static_cast<uint32_t>(scene_.vertices.size());
        scene_.vertices.push_back(weld.positions[weld.vertex[i]]);
      }
      out[corner_of[i - known.size()]] = vertex;
    }
  }

  // Replaces triangles by their pieces.
  void replace(const std::vector<bool>& is_covered) {
    const std::vector<uint32_t> vertices = find_vertices();
    Scene old = {};
    std::swap(old.triangles, scene_.triangles);
    std::swap(old.triangle_object, scene_.triangle_object);
    std::swap(old.triangle_surface, scene_.triangle_surface);
    const auto keep = [&](uint32_t t, const std::array<uint32_t, 3>& corners) {
      scene_.triangles.push_back(corners);
      scene_.triangle_object.push_back(old.triangle_object[t]);
      scene_.triangle_surface.push_back(old.triangle_surface[t]);
    };
    size_t piece = 0, corner = 0;
    for (uint32_t t = 0; t < old.triangles.size(); ++t) {
      if (!is_covered[t]) keep(t, old.triangles[t]);
      for (; piece < pieces_.size() && pieces_[piece].triangle == t; ++piece) {
        for (const auto& [a, b, c] : best_fan(pieces_[piece].polygon)) {
          keep(t, {vertices[corner + a], vertices[corner + b], vertices[corner + c]});
          if (triangle_shape(scene_, static_cast<uint32_t>(scene_.triangles.size() - 1)).height_m >=
              degenerate_height_m)
            continue;
          scene_.triangles.pop_back();
          scene_.triangle_object.pop_back();
          scene_.triangle_surface.pop_back();
        }
        corner += pieces_[piece].polygon.size();
      }
    }
  }

  Scene& scene_;
  std::span<const std::array<uint32_t, 3>> triangle_edges_;
  std::vector<CoveredPair> pairs_;
  std::vector<bool> equally_large_;  // one for each pair, in the original order
  std::vector<PieceOfTriangle> pieces_;
};

}  // namespace

void cut_covered_faces(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges) {
  std::vector<CoveredPair> pairs = coplanar_pairs(scene);
  if (pairs.empty()) return;
  FaceCovering(scene, triangle_edges, std::move(pairs)).cut();
  drop_unused_vertices(scene);
  find_edges(scene);
  list_surfaces(scene);
}

}  // namespace wavetracer
