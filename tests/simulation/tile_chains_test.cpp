// SPDX-License-Identifier: Apache-2.0
// All paths that scatter from a tile, with reflections before and after it, against a search of every chain of mirrors
// and every tile that is written here.
#include <optional>

#include "scene/load.hpp"
#include "scene/tiles.hpp"
#include "simulation/rough_room.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

// The image method, the test of legs and the search are written for this test, in double and without tolerances.
struct Room {
  Scene scene;
  std::vector<Tile> tiles;

  double above(uint32_t surface, const dvec3& p) const {
    return glm::dot(scene.surfaces[surface].normal, p) - scene.surfaces[surface].offset_m;
  }
  bool contains(size_t triangle, const dvec3& p) const {
    dvec3 v[3];
    for (size_t k = 0; k < 3; ++k) v[k] = scene.vertices[scene.triangles[triangle][k]];
    const dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    for (size_t k = 0; k < 3; ++k)
      if (glm::dot(normal, glm::cross(v[(k + 1) % 3] - v[k], p - v[k])) < 0) return false;
    return true;
  }
  bool on_surface(uint32_t surface, const dvec3& p) const {
    for (size_t t = 0; t < scene.triangles.size(); ++t)
      if (scene.triangle_surface[t] == surface && contains(t, p)) return true;
    return false;
  }
  // Does a surface stand between two points, other than those that they are on?
  bool hidden(const dvec3& a, uint32_t on_a, const dvec3& b, uint32_t on_b) const {
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
      const uint32_t s = scene.triangle_surface[t];
      const double x = above(s, a), y = above(s, b);
      if (s == on_a || s == on_b || x * y >= 0) continue;
      if (contains(t, a + (b - a) * (x / (x - y)))) return true;
    }
    return false;
  }
  // The points of the reflections from the end to the tile, if the tile is seen so.
  std::optional<std::vector<dvec3>> half(const dvec3& end, const std::vector<uint32_t>& chain, const Tile& tile) const {
    std::vector<dvec3> images{end}, points(chain.size());
    for (const uint32_t s : chain)
      images.push_back(images.back() - 2 * above(s, images.back()) * scene.surfaces[s].normal);
    dvec3 target = tile.centre_m;
    for (size_t k = chain.size(); k-- > 0;) {
      const double a = above(chain[k], images[k + 1]), b = above(chain[k], target);
      if (a * b >= 0) return {};
      target = points[k] = images[k + 1] + (target - images[k + 1]) * (a / (a - b));
      if (!on_surface(chain[k], target)) return {};
    }
    dvec3 from = end;
    uint32_t on = no_surface;
    for (size_t k = 0; k <= chain.size(); ++k) {
      const bool last = k == chain.size();
      const dvec3 to = last ? tile.centre_m : points[k];
      const uint32_t on_to = last ? tile.surface : chain[k];
      if (k > 0 && above(chain[k - 1], k > 1 ? points[k - 2] : end) * above(chain[k - 1], to) <= 0) return {};
      if (hidden(from, on, to, on_to)) return {};
      from = to;
      on = on_to;
    }
    return points;
  }
  static constexpr uint32_t no_surface = 0xFFFFFFFFu;
};

std::vector<std::vector<uint32_t>> chains_up_to(uint32_t length, uint32_t surfaces) {
  std::vector<std::vector<uint32_t>> out{{}};
  for (size_t i = 0; i < out.size(); ++i)
    for (uint32_t s = 0; out[i].size() < length && s < surfaces; ++s) {
      if (!out[i].empty() && out[i].back() == s) continue;
      out.push_back(out[i]);
      out.back().push_back(s);
    }
  return out;
}

PathsOfTiles every_path(const Room& room, const Points& from, const Points& to, uint32_t reflections) {
  struct Half {
    uint32_t end;
    std::vector<uint32_t> chain;
    std::vector<dvec3> points;
    bool above;
  };
  const auto chains = chains_up_to(reflections, static_cast<uint32_t>(room.scene.surfaces.size()));
  PathsOfTiles out;
  for (const Tile& tile : room.tiles) {
    const auto halves = [&](const Points& ends) {
      std::vector<Half> found;
      for (uint32_t end = 0; end < ends.size(); ++end)
        for (const auto& chain : chains)
          if (const auto points = room.half(ends[end] - room.scene.origin_m, chain, tile)) {
            const dvec3 last = points->empty() ? ends[end] - room.scene.origin_m : points->back();
            found.push_back({end, chain, *points, room.above(tile.surface, last) > 0});
          }
      return found;
    };
    const std::vector<Half> heard = halves(to);
    for (const Half& a : halves(from))
      for (const Half& b : heard) {
        if (a.above != b.above) continue;
        Steps steps;
        std::vector<dvec3> points = a.points;
        for (const uint32_t s : a.chain) steps.emplace_back(reflection, s);
        steps.emplace_back(scattering, tile.surface);
        points.push_back(tile.centre_m);
        for (size_t k = b.chain.size(); k-- > 0;) {
          steps.emplace_back(reflection, b.chain[k]);
          points.push_back(b.points[k]);
        }
        for (dvec3& p : points) p += room.scene.origin_m;
        out.emplace(PathOfTile{a.end, b.end, steps}, points);
      }
  }
  return out;
}

}  // namespace

TEST_CASE("a room with a partition: the paths of every chain up to length 2 and every tile, and no others") {
  const SceneFile file(std::vector<Part>{{partitioned_room(), "concrete"}});
  const Config config = rough_room(file, room_from, room_to, 2);
  Room room{load_scene(config), {}};
  room.tiles = make_tiles(room.scene, config.trace.tile_m);
  const PathsOfTiles wanted = every_path(room, room_from, room_to, 2);
  CHECK(wanted.size() > 5000);
  check_equal(scattered_paths(run(config).paths), wanted);
  Config by_rays = config;
  by_rays.trace.discovery = "rays";
  by_rays.trace.rays = 100000;
  check_equal(scattered_paths(run(by_rays).paths), wanted);
  Config shorter = config;
  shorter.trace.max_depth = 3;
  PathsOfTiles short_ones = wanted;
  std::erase_if(short_ones, [](const auto& path) { return std::get<2>(path.first).size() > 3; });
  CHECK(short_ones.size() < wanted.size() / 2);
  check_equal(scattered_paths(run(shorter).paths), short_ones);
}
