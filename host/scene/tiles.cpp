// SPDX-License-Identifier: Apache-2.0
// Halves the longest side (M. Rivara, Int. J. Numer. Methods Eng. 20, 1984), which makes no thin tiles of good
// triangles: no angle falls below half of the smallest one (I. Rosenberg and F. Stenger, Math. Comp. 29, 1975).
#include "scene/tiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "scene/earlier_faces.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using Corners = std::array<glm::dvec3, 3>;

double area_m2(const Corners& c) { return glm::length(glm::cross(c[1] - c[0], c[2] - c[0])) / 2; }

// Calls visit(corners) for every tile, in order, as long as it returns true. Returns what the last one did.
template <class Visit>
bool cut(const Corners& c, double tile_m, const Visit& visit) {
  const glm::dvec3 u = c[1] - c[0], v = c[2] - c[1], w = c[0] - c[2];
  const std::array<double, 3> side_m2{glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)};
  // The first one if several are equal.
  const auto k = static_cast<size_t>(std::ranges::max_element(side_m2) - side_m2.begin());
  if (!(side_m2[k] > tile_m * tile_m)) return visit(c);
  const glm::dvec3 &a = c[k], &b = c[(k + 1) % 3], &opposite = c[(k + 2) % 3], middle = (a + b) / 2.0;
  return cut({a, middle, opposite}, tile_m, visit) && cut({middle, b, opposite}, tile_m, visit);
}

// Calls visit(surface, triangle, corners) for every triangle that scatters.
template <class Visit>
void for_scattering_triangles(const Scene& scene, const Visit& visit) {
  for (uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    if (!(scene.materials[surface.material].scattering > 0)) continue;
    for (uint32_t k = 0; k < surface.triangle_count; ++k) {
      const uint32_t triangle = scene.surface_triangles[surface.first_triangle + k];
      const auto& t = scene.triangles[triangle];
      visit(s, triangle, Corners{scene.vertices[t[0]], scene.vertices[t[1]], scene.vertices[t[2]]});
    }
  }
}

// Returns the number of tiles of a scene before those on earlier triangles are left out. If that exceeds `most`, the
// result is some number above `most`, no larger than the true one.
uint64_t tile_count(const Scene& scene, double tile_m, uint64_t most) {
  double area = 0;
  for_scattering_triangles(scene, [&](uint32_t, uint32_t, const Corners& corners) { area += area_m2(corners); });
  // No triangle with sides of at most tile_m has more area than the equilateral one.
  const double least = area / (std::numbers::sqrt3 / 4 * tile_m * tile_m);
  if (least > static_cast<double>(most)) return static_cast<uint64_t>(std::min(least, 1e18));
  uint64_t count = 0;
  for_scattering_triangles(scene, [&](uint32_t, uint32_t, const Corners& corners) {
    if (count <= most) cut(corners, tile_m, [&](const Corners&) { return ++count <= most; });
  });
  return count;
}

}  // namespace

std::vector<Tile> make_tiles(const Scene& scene, double tile_m) {
  std::vector<Tile> tiles;
  const EarlierFaces earlier(scene);
  for_scattering_triangles(scene, [&](uint32_t surface, uint32_t triangle, const Corners& corners) {
    const glm::dvec3& normal = scene.surfaces[surface].normal;
    const double offset_m = scene.surfaces[surface].offset_m;
    cut(corners, tile_m, [&](const Corners& c) {
      const glm::dvec3 centre = (c[0] + c[1] + c[2]) / 3.0;
      if (earlier.hold(triangle, centre)) return true;
      tiles.push_back({centre - (glm::dot(normal, centre) - offset_m) * normal, area_m2(c), surface});
      return true;
    });
  });
  return tiles;
}

TileTable::TileTable(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances,
                     double tile_m, uint64_t most)
    : instances_(instances) {
  std::vector<uint64_t> copies(models.size(), 0);
  for (const Instance& instance : instances) ++copies[instance.model];
  const auto count = [&](double size_m, uint64_t enough) {
    auto all = static_cast<double>(tile_count(scene, size_m, enough));
    for (size_t m = 0; m < models.size(); ++m)
      if (copies[m] > 0)
        all += static_cast<double>(copies[m]) * static_cast<double>(tile_count(models[m], size_m, enough / copies[m]));
    return all;
  };
  if (const double found = count(tile_m, most); found > static_cast<double>(most)) {
    constexpr uint64_t fair = most_tiles / 64;  // a number of tiles whose paths some device may hold
    double enough_m = tile_m;
    while (std::isfinite(enough_m) && count(enough_m, fair) > static_cast<double>(fair)) enough_m *= 2;
    throw ConfigError(
        fmt::format("trace.tile_m = {:g} cuts the surfaces that scatter into {:.3g} tiles or more, "
                    "but at most {} are possible here; use trace.tile_m = {:g} or more. "
                    "Every tile is one path for each link that sees it",
                    tile_m, found, most, enough_m));
  }
  parts_.push_back(make_tiles(scene, tile_m));
  for (size_t m = 0; m < models.size(); ++m)
    parts_.push_back(copies[m] > 0 ? make_tiles(models[m], tile_m) : std::vector<Tile>{});
  size_ = static_cast<uint32_t>(parts_[0].size());
  for (const Instance& instance : instances) {
    first_.push_back(size_);
    size_ += static_cast<uint32_t>(parts_[1 + instance.model].size());
  }
}

TilePlace TileTable::at(uint32_t id) const {
  if (id >= size_) throw std::out_of_range(fmt::format("tile {} of {}", id, size_));
  if (id < parts_[0].size()) return {0, id, no_instance};
  // The last instance that begins at or before id: earlier ones with the same beginning have no tiles.
  const auto instance = static_cast<uint32_t>(std::ranges::upper_bound(first_, id) - first_.begin() - 1);
  return {1 + instances_[instance].model, id - first_[instance], instance};
}

}  // namespace wavetracer
