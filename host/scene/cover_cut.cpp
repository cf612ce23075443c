// SPDX-License-Identifier: Apache-2.0
// The cover nearest to the middle of a piece cuts it into up to three pieces beside the cover. Each piece goes on with
// only those covers that reach its side of the lines, so that each cover meets few pieces.
#include "scene/cover_cut.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <tuple>

#include "scene/weld.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;

struct CutTask {
  ConvexPolygon piece;
  std::vector<uint32_t> covers;  // the triangles that may overlap the piece
};

dvec3 middle_of(std::span<const dvec3> corners) {
  dvec3 sum(0);
  for (const dvec3& p : corners) sum += p;
  return sum / static_cast<double>(corners.size());
}

class CoverCutter {
 public:
  explicit CoverCutter(std::span<const CoverTriangle> covers) : covers_(covers) {
    for (const CoverTriangle& cover : covers) middles_.push_back(middle_of(cover.corners));
  }

  std::vector<ConvexPolygon> cut(ConvexPolygon polygon) {
    std::vector<uint32_t> all;
    for (uint32_t i = 0; i < covers_.size(); ++i) all.push_back(i);
    tasks_.push_back({std::move(polygon), std::move(all)});
    while (!tasks_.empty()) {
      CutTask task = std::move(tasks_.back());
      tasks_.pop_back();
      if (!cut_by_one(task)) left_.push_back(std::move(task.piece));
    }
    return std::move(left_);
  }

 private:
  // Cuts the piece by the nearest cover that overlaps it; returns false if none does.
  bool cut_by_one(CutTask& task) {
    const dvec3 middle = middle_of(task.piece);
    while (!task.covers.empty()) {
      const auto nearest = std::ranges::min_element(task.covers, [&](uint32_t a, uint32_t b) {
        const dvec3 &p = middles_[a], &q = middles_[b];
        const double p_m = glm::distance(p, middle), q_m = glm::distance(q, middle);
        return std::tie(p_m, p.x, p.y, p.z) < std::tie(q_m, q.x, q.y, q.z);
      });
      const uint32_t cover = *nearest;
      *nearest = task.covers.back();
      task.covers.pop_back();
      if (covered_part(task.piece, covers_[cover]).empty()) continue;
      cut_beside(std::move(task), covers_[cover]);
      return true;
    }
    return false;
  }

  void cut_beside(CutTask task, const CoverTriangle& cover) {
    for (const CutLine& side : cover.sides) {
      CutParts parts = cut_convex(task.piece, side, weld_tolerance_m);
      if (polygon_width_m(parts.outside) > weld_tolerance_m)
        tasks_.push_back({std::move(parts.outside), reaching(task.covers, side, -1)});
      task.covers = reaching(task.covers, side, 1);
      task.piece = std::move(parts.inside);
    }
  }

  // Returns the covers that have a corner on this side of a line.
  std::vector<uint32_t> reaching(const std::vector<uint32_t>& covers, const CutLine& line, double sense) const {
    std::vector<uint32_t> out;
    for (const uint32_t i : covers)
      if (std::ranges::any_of(covers_[i].corners,
                              [&](const dvec3& p) { return sense * line.beyond_m(p) > weld_tolerance_m; }))
        out.push_back(i);
    return out;
  }

  std::span<const CoverTriangle> covers_;
  std::vector<dvec3> middles_;
  std::vector<CutTask> tasks_;
  std::vector<ConvexPolygon> left_;
};

}  // namespace

CoverTriangle cover_triangle(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges, uint32_t t,
                             const dvec3& normal) {
  CoverTriangle out{side_lines(scene, t, normal), {}};
  for (size_t k = 0; k < 3; ++k) out.corners[k] = scene.vertices[scene.triangles[t][k]];
  std::array<size_t, 3> order{0, 1, 2};
  std::ranges::stable_partition(order, [&](size_t k) {
    const Edge& edge = scene.edges[triangle_edges[t][k]];
    for (uint32_t i = 0; i < edge.face_count; ++i) {
      const uint32_t other = scene.edge_faces[edge.first_face + i];
      if (other != t && scene.triangle_surface[other] == scene.triangle_surface[t]) return false;
    }
    return true;
  });
  out.sides = {out.sides[order[0]], out.sides[order[1]], out.sides[order[2]]};
  return out;
}

ConvexPolygon covered_part(const ConvexPolygon& polygon, const CoverTriangle& cover) {
  ConvexPolygon rest = polygon;
  for (const CutLine& side : cover.sides) {
    if (rest.empty()) return {};
    rest = cut_convex(rest, side, weld_tolerance_m).inside;
  }
  return polygon_width_m(rest) > weld_tolerance_m ? rest : ConvexPolygon{};
}

std::vector<ConvexPolygon> uncovered_parts(ConvexPolygon polygon, std::span<const CoverTriangle> covers) {
  return CoverCutter(covers).cut(std::move(polygon));
}

}  // namespace wavetracer
