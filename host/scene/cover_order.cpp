// SPDX-License-Identifier: Apache-2.0
// Surfaces are joined over the free edges that flat_neighbours.hpp finds along each other.
#include "scene/cover_order.hpp"

#include <algorithm>
#include <cmath>

#include "base/forest.hpp"
#include "scene/flat_neighbours.hpp"
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

}  // namespace wavetracer
