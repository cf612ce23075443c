// SPDX-License-Identifier: Apache-2.0
// Corners with the same coordinates are one vertex, so that triangles of one surface meet at equal sides.
#include "passes/beam_facets.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

namespace wavetracer {
namespace {

constexpr double no_bound = std::numeric_limits<double>::infinity();

constexpr double flat_m = 1e-9;

using Loop = std::vector<uint32_t>;  // vertices of a polygon, around its normal
using Side = std::pair<uint32_t, uint32_t>;

// Twice the area of a polygon, along its normal (Newell).
glm::dvec3 area_of(const std::vector<glm::dvec3>& vertices, const Loop& loop) {
  glm::dvec3 sum(0.0);
  for (size_t i = 1; i + 1 < loop.size(); ++i)
    sum += glm::cross(vertices[loop[i]] - vertices[loop[0]], vertices[loop[i + 1]] - vertices[loop[0]]);
  return sum;
}

bool is_convex(const std::vector<glm::dvec3>& vertices, const Loop& loop, const glm::dvec3& normal) {
  for (size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec3 at = vertices[loop[(i + 1) % loop.size()]], in = at - vertices[loop[i]],
                     out = vertices[loop[(i + 2) % loop.size()]] - at;
    if (glm::dot(glm::cross(in, out), normal) < -1e-12 * glm::length(in) * glm::length(out)) return false;
    if (std::abs(glm::dot(normal, at - vertices[loop[0]])) > flat_m) return false;
  }
  return true;
}

// The polygons of one surface, while they are put together.
class Union {
 public:
  Union(const std::vector<glm::dvec3>& vertices, std::vector<Loop> loops)
      : vertices_(vertices), loops_(std::move(loops)) {
    for (uint32_t i = 0; i < loops_.size(); ++i) for_sides(loops_[i], [&](Side side) { loop_of_.emplace(side, i); });
  }

  std::vector<Loop> put_together() {
    std::vector<std::tuple<double, Side>> shared;
    for (const auto& [side, loop] : loop_of_)
      if (side.first < side.second && loop_of_.contains({side.second, side.first}))
        shared.emplace_back(-glm::length(vertices_[side.second] - vertices_[side.first]), side);
    std::ranges::sort(shared);
    for (const auto& [length, side] : shared) join(side);
    std::erase_if(loops_, [](const Loop& loop) { return loop.empty(); });
    return std::move(loops_);
  }

 private:
  template <class Take>
  static void for_sides(const Loop& loop, const Take& take) {
    for (size_t i = 0; i < loop.size(); ++i) take(Side{loop[i], loop[(i + 1) % loop.size()]});
  }

  // The vertices of a loop from the end of a side to its begin.
  static Loop without_side(const Loop& loop, Side side) {
    const size_t at = static_cast<size_t>(std::ranges::find(loop, side.second) - loop.begin());
    Loop out;
    for (size_t i = 0; i < loop.size(); ++i) out.push_back(loop[(at + i) % loop.size()]);
    return out;
  }

  // Takes out vertices that the loop goes to and comes back from.
  static void take_out_spikes(Loop& loop) {
    for (size_t i = 0; loop.size() > 3 && i < loop.size(); ++i) {
      const size_t next = (i + 1) % loop.size(), after = (i + 2) % loop.size();
      if (loop[i] != loop[after]) continue;
      Loop left;
      for (size_t k = 0; k < loop.size(); ++k)
        if (k != next && k != after) left.push_back(loop[k]);
      loop = left;
      i = static_cast<size_t>(-1);
    }
  }

  void join(Side side) {
    const auto one = loop_of_.find(side), other = loop_of_.find({side.second, side.first});
    if (one == loop_of_.end() || other == loop_of_.end() || one->second == other->second) return;
    const uint32_t a = one->second, b = other->second;
    if (loops_[a].size() + loops_[b].size() > WT_FACET_CORNERS + 4) return;
    Loop joined = without_side(loops_[a], side);
    const Loop rest = without_side(loops_[b], {side.second, side.first});
    joined.insert(joined.end(), rest.begin() + 1, rest.end() - 1);
    take_out_spikes(joined);
    Loop sorted = joined;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end() || joined.size() > WT_FACET_CORNERS) return;
    const glm::dvec3 area = area_of(vertices_, joined);
    if (!is_convex(vertices_, joined, area / glm::length(area))) return;
    for (const uint32_t i : {a, b}) for_sides(loops_[i], [&](Side s) { loop_of_.erase(s); });
    loops_[b].clear();
    loops_[a] = std::move(joined);
    for_sides(loops_[a], [&](Side s) { loop_of_.emplace(s, a); });
  }

  const std::vector<glm::dvec3>& vertices_;
  std::vector<Loop> loops_;
  std::map<Side, uint32_t> loop_of_;  // for each side, the loop that has it in this direction
};

void add_facet(std::span<const glm::dvec3> corners, uint32_t surface, Facets& out) {
  glm::dvec3 area(0.0);
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    area += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  const glm::dvec3 normal = area / glm::length(area);
  wt_facet facet{};
  facet.low = no_bound;
  facet.high = -no_bound;
  facet.first_corner = static_cast<uint32_t>(out.corners.size());
  facet.count = static_cast<uint32_t>(corners.size());
  facet.surface = surface;
  for (int axis = 0; axis < 3; ++axis) facet.normal[axis] = normal[axis];
  for (const glm::dvec3& corner : corners) {
    const double at = glm::dot(normal, corner);
    facet.low = std::min(facet.low, at);
    facet.high = std::max(facet.high, at);
    out.corners.push_back(corner);
  }
  out.facets.push_back(facet);
}

// The facets of a scene or model, in its coordinates and with its numbers of surfaces.
Facets facets_of(const Scene& scene) {
  std::vector<SurfaceTriangle> triangles;
  for (const uint32_t t : scene.surface_triangles) {
    const auto& [a, b, c] = scene.triangles[t];
    triangles.push_back({{scene.vertices[a], scene.vertices[b], scene.vertices[c]}, scene.triangle_surface[t]});
  }
  return make_facets(triangles);
}

}  // namespace

Facets make_facets(std::span<const SurfaceTriangle> triangles) {
  Facets out;
  for (size_t first = 0, end = 0; first < triangles.size(); first = end) {
    const uint32_t surface = triangles[first].surface;
    std::vector<glm::dvec3> vertices;
    std::map<std::array<double, 3>, uint32_t> vertex_of;
    std::vector<Loop> loops;
    for (; end < triangles.size() && triangles[end].surface == surface; ++end) {
      Loop loop;
      for (const glm::dvec3& corner : triangles[end].corners) {
        const auto [at, is_new] =
            vertex_of.try_emplace({corner.x, corner.y, corner.z}, static_cast<uint32_t>(vertices.size()));
        if (is_new) vertices.push_back(corner);
        loop.push_back(at->second);
      }
      if (glm::length(area_of(vertices, loop)) > 0.0) loops.push_back(std::move(loop));
    }
    for (const Loop& loop : Union(vertices, std::move(loops)).put_together()) {
      std::vector<glm::dvec3> corners;
      for (const uint32_t v : loop) corners.push_back(vertices[v]);
      add_facet(corners, surface, out);
    }
  }
  return out;
}

WorldFacets::WorldFacets(const Scene& scene, const std::vector<Scene>& models) : scene_(facets_of(scene)) {
  for (const Scene& model : models) models_.push_back(facets_of(model));
}

WorldFacets::Moving WorldFacets::moving(const std::vector<Instance>& instances,
                                        std::span<const Placement> placements) const {
  Moving out;
  for (size_t i = 0; i < instances.size(); ++i) {
    if (!placements[i].present) continue;
    const Facets& model = models_[instances[i].model];
    glm::dvec3 low(no_bound), high(-no_bound);
    for (const wt_facet& facet : model.facets) {
      std::vector<glm::dvec3> corners;
      for (uint32_t k = 0; k < facet.count; ++k) {
        corners.push_back(placements[i].position_m + placements[i].rotation * model.corners[facet.first_corner + k]);
        low = glm::min(low, corners.back());
        high = glm::max(high, corners.back());
      }
      add_facet(corners, instances[i].first_surface + facet.surface, out.facets);
    }
    if (!model.facets.empty()) out.boxes.push_back({{low.x, low.y, low.z}, {high.x, high.y, high.z}});
  }
  return out;
}

}  // namespace wavetracer
