// SPDX-License-Identifier: Apache-2.0
// Surfaces are joined over the free edges that flat_mesh.hpp finds along each other. Planes are handed on from the
// largest surface that covers others to the smallest.
#include "scene/cover_order.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "base/forest.hpp"
#include "scene/flat_mesh.hpp"
#include "scene/topology.hpp"

namespace wavetracer {
namespace {

// Rounding to six digits makes sums in another order give the same number, except for about one sum in 10^10.
double in_six_digits(double x) {
  if (!(x > 0)) return 0;
  const double step = std::pow(10.0, std::floor(std::log10(x)) - 5);
  return std::round(x / step) * step;
}

bool goes_on(const Scene& scene, const FlatNeighbours& neighbours, const FlatNeighbour& pair) {
  const Surface &a = scene.surfaces[scene.triangle_surface[pair.triangle]],
                &b = scene.surfaces[scene.triangle_surface[pair.other]];
  if (a.material != b.material || !neighbours.unfolded(pair, a.normal)) return false;
  return triangle_is_near(scene, pair.other, plane_of(a), flat_as_it_is_m);
}

// Orders surfaces of equal area and material by their place, not by their number.
auto place_of(const Surface& s) { return std::tuple(s.lower.x, s.lower.y, s.lower.z, s.upper.x, s.upper.y, s.upper.z); }

}  // namespace

CoverOrder::CoverOrder(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges)
    : scene_(scene), area_m2_(scene.surfaces.size(), 0) {
  Forest joined(scene.surfaces.size());
  const FlatNeighbours neighbours(scene, triangle_edges);
  for (uint32_t t = 0; t < scene.triangles.size(); ++t)
    neighbours.visit(t, [&](const FlatNeighbour& pair) {
      const uint32_t a = scene.triangle_surface[t], b = scene.triangle_surface[pair.other];
      if (joined.root(a) != joined.root(b) && goes_on(scene, neighbours, pair)) joined.join(a, b);
    });
  for (uint32_t t = 0; t < scene.triangles.size(); ++t)
    area_m2_[joined.root(scene.triangle_surface[t])] += triangle_shape(scene, t).area_m2;
  for (uint32_t s = 0; s < area_m2_.size(); ++s) area_m2_[s] = joined.root(s) == s ? in_six_digits(area_m2_[s]) : 0;
  for (uint32_t s = 0; s < area_m2_.size(); ++s) area_m2_[s] = area_m2_[joined.root(s)];
}

std::pair<double, std::string_view> CoverOrder::key(uint32_t surface) const {
  return {area_m2_[surface], scene_.materials[scene_.surfaces[surface].material].name};
}

void share_planes(Scene& scene, const CoverOrder& order, std::span<const std::pair<uint32_t, uint32_t>> pairs) {
  const auto is_smaller = [&](uint32_t a, uint32_t b) {
    if (order.covers(a, b) || order.covers(b, a)) return order.covers(a, b);
    return place_of(scene.surfaces[a]) < place_of(scene.surfaces[b]);
  };
  std::map<uint32_t, uint32_t> largest_below;  // for each surface that covers others, the largest one below it
  for (const auto& [covered, cover] : pairs) {
    const uint32_t below = scene.triangle_surface[covered];
    const auto [at, is_new] = largest_below.try_emplace(scene.triangle_surface[cover], below);
    if (!is_new && is_smaller(at->second, below)) at->second = below;
  }
  std::vector<std::pair<uint32_t, uint32_t>> covers(largest_below.begin(), largest_below.end());
  std::ranges::sort(covers, [&](const auto& a, const auto& b) { return is_smaller(b.first, a.first); });
  for (const auto& [cover, below] : covers) {
    Surface& surface = scene.surfaces[cover];
    const Surface& plane = scene.surfaces[below];
    if (glm::length(glm::cross(surface.normal, plane.normal)) <= same_plane_rad) continue;
    if (!surface_is_near(scene, surface, plane_of(plane), flat_as_it_is_m)) continue;
    surface.normal = plane.normal;
    surface.offset_m = plane.offset_m;
  }
}

}  // namespace wavetracer
