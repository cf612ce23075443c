// SPDX-License-Identifier: Apache-2.0
// Surfaces are handled from the largest that covers others to the smallest, so that a plane is handed on from one to
// the next.
#include "scene/cover_planes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>
#include <vector>

#include "scene/topology.hpp"

namespace wavetracer {
namespace {

// Orders surfaces of equal area and material by their place, not by their number.
auto place_of(const Surface& s) { return std::tuple(s.lower.x, s.lower.y, s.lower.z, s.upper.x, s.upper.y, s.upper.z); }

}  // namespace

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
