// SPDX-License-Identifier: Apache-2.0
// Tests tiles of diffuse scattering: they cover exactly the surfaces that scatter, and none is too long. Right
// isosceles triangles have counts in closed form: each bisection halves the area and divides the longest side by sqrt
// 2.
#include "scene/tiles.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>
#include <stdexcept>

#include "wavetracer/error.hpp"

using namespace wavetracer;
using glm::dvec3;

namespace {

// One surface per triangle list, all in one plane; the material of each is given by its scattering coefficient.
struct Patch {
  std::vector<std::array<dvec3, 3>> triangles;
  double scattering;
};

Scene scene_of(const std::vector<Patch>& patches) {
  Scene scene;
  for (const Patch& patch : patches) {
    const auto& t = patch.triangles[0];
    Surface surface;
    surface.normal = glm::normalize(glm::cross(t[1] - t[0], t[2] - t[0]));
    surface.offset_m = glm::dot(surface.normal, t[0]);
    surface.material = static_cast<uint32_t>(scene.materials.size());
    surface.first_triangle = static_cast<uint32_t>(scene.surface_triangles.size());
    surface.triangle_count = static_cast<uint32_t>(patch.triangles.size());
    scene.materials.push_back({.name = "rough", .scattering = patch.scattering});
    scene.surfaces.push_back(surface);
    for (const auto& corners : patch.triangles) {
      const auto first = static_cast<uint32_t>(scene.vertices.size());
      scene.surface_triangles.push_back(static_cast<uint32_t>(scene.triangles.size()));
      scene.triangles.push_back({first, first + 1, first + 2});
      scene.vertices.insert(scene.vertices.end(), corners.begin(), corners.end());
    }
  }
  return scene;
}

Patch square(double side_m, double scattering, double z = 0) {
  const dvec3 a{0, 0, z}, b{side_m, 0, z}, c{side_m, side_m, z}, d{0, side_m, z};
  return {{{a, b, c}, {a, c, d}}, scattering};
}

}  // namespace

TEST_CASE("a square of 8 m: 16 tiles of 4 m, and four times as many each time they are half as long") {
  const Scene scene = scene_of({square(8, 0.5)});
  size_t expected = 16;
  for (const double tile_m : {4.0, 2.0, 1.0, 0.5, 0.25}) {
    CAPTURE(tile_m);
    // Just above and below the limit: a longest side of exactly tile_m is kept, however it is rounded.
    CHECK(make_tiles(scene, tile_m * (1 + 1e-9)).size() == expected);
    CHECK(make_tiles(scene, tile_m * (1 - 1e-9)).size() == 2 * expected);
    expected *= 4;
  }
  CHECK(make_tiles(scene, 100).size() == 2);
}

TEST_CASE("tiles of any triangle cover it: area, first moment, and every point is near a centre") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-20, 20), share(0, 1);
  for (int i = 0; i < 30; ++i) {
    const std::array<dvec3, 3> t{dvec3{at(random), at(random), at(random)}, dvec3{at(random), at(random), at(random)},
                                 dvec3{at(random), at(random), at(random)}};
    const Scene scene = scene_of({{{t}, 0.3}});
    const double tile_m = 0.5 + 3 * share(random);
    const double area = glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
    double sum = 0, largest = 0;
    dvec3 moment{0};
    const std::vector<Tile> tiles = make_tiles(scene, tile_m);
    for (const Tile& tile : tiles) {
      sum += tile.area_m2;
      moment += tile.area_m2 * tile.centre_m;
      largest = std::max(largest, tile.area_m2);
    }
    CHECK(sum == doctest::Approx(area).epsilon(1e-12));
    CHECK(glm::length(moment / sum - (t[0] + t[1] + t[2]) / 3.0) < 1e-10);
    CHECK(largest <= std::sqrt(3.0) / 4 * tile_m * tile_m);  // the equilateral one
    for (int k = 0; k < 20; ++k) {
      double u = share(random), v = share(random);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const dvec3 p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      // No point of a triangle is farther from its centroid than two thirds of its longest side.
      CHECK(std::ranges::any_of(
          tiles, [&](const Tile& tile) { return glm::distance(tile.centre_m, p) <= tile_m * (2.0 / 3 + 1e-12); }));
    }
  }
}

TEST_CASE("only surfaces that scatter have tiles, in order, and centres lie on the surface's plane") {
  Scene scene = scene_of({square(4, 0, 0), square(4, 0.2, 1), square(4, 0, 2), square(4, 1, 3)});
  scene.vertices[6].z += 1.5e-3;  // surfaces are flat to 2 mm
  const std::vector<Tile> tiles = make_tiles(scene, 1);
  REQUIRE(!tiles.empty());
  CHECK(tiles.front().surface == 1);
  CHECK(tiles.back().surface == 3);
  CHECK(std::ranges::is_sorted(tiles, {}, &Tile::surface));
  for (const Tile& tile : tiles) {
    CHECK((tile.surface == 1 || tile.surface == 3));
    CHECK(std::abs(tile.centre_m.z - scene.surfaces[tile.surface].offset_m) < 1e-12);
  }
  const std::vector<Tile> again = make_tiles(scene, 1);
  CHECK(std::ranges::equal(tiles, again, [](const Tile& a, const Tile& b) {
    return a.centre_m == b.centre_m && a.area_m2 == b.area_m2 && a.surface == b.surface;
  }));
}

TEST_CASE("numbers go through the world: static tiles, then instance by instance") {
  const Scene scene = scene_of({square(8, 0), square(8, 0.5)});
  const std::vector<Scene> models{scene_of({square(2, 0.5), square(2, 0.4, 1)}), scene_of({square(2, 0)})};
  const std::vector<Instance> instances{{"a", "t", 0, 2}, {"b", "t", 1, 4}, {"c", "t", 0, 5}, {"d", "t", 1, 7}};
  const TileTable table(scene, models, instances, 2 * (1 + 1e-9));
  const auto still = static_cast<uint32_t>(table.tiles(0).size());
  const auto moving = static_cast<uint32_t>(table.tiles(1).size());
  CHECK(still == 64);
  CHECK(moving == 8);
  CHECK(table.tiles(2).empty());
  CHECK(table.size() == still + 2 * moving);
  for (uint32_t id = 0; id < table.size(); ++id) {
    const TilePlace place = table.at(id);
    if (id < still) {
      CHECK(place.instance == no_instance);
      CHECK(place.tile == id);
      CHECK(table.surface(place) == 1);
    } else {
      CHECK(place.instance == (id < still + moving ? 0 : 2));
      CHECK(place.part == 1);
      CHECK(table.first_tile(place.instance) + place.tile == id);
      CHECK(table.surface(place) == instances[place.instance].first_surface + (place.tile < 4 ? 0 : 1));
    }
  }
  CHECK_THROWS_AS(table.at(table.size()), std::out_of_range);
}

TEST_CASE("too many tiles: an error that names the key and a value that would do") {
  const Scene scene = scene_of({square(8, 0.5)});
  CHECK_THROWS_WITH_AS(TileTable(scene, {}, {}, 1e-5), doctest::Contains("trace.tile_m = 1e-05 cuts"), ConfigError);
  CHECK_THROWS_WITH_AS(TileTable(scene, {}, {}, 1e-5), doctest::Contains("use trace.tile_m = 0.01024 or more"),
                       ConfigError);
  CHECK(make_tiles(scene, 0.01024).size() <= TileTable::most_tiles / 64);
  // Every instance of a model counts: 65,536 tiles of 6.25 cm each.
  const Scene smooth = scene_of({square(8, 0)});
  const std::vector<Scene> models{scene};
  CHECK_NOTHROW(TileTable(smooth, models, std::vector<Instance>(4095, {"v", "t", 0, 1}), 0.0626));
  CHECK_THROWS_AS(TileTable(smooth, models, std::vector<Instance>(4097, {"v", "t", 0, 1}), 0.0626), ConfigError);
}

TEST_CASE("where triangles of one plane overlap, each place has the tiles of the first one alone") {
  const auto area = [](const Scene& scene, uint32_t surface) {
    double out = 0;
    for (const Tile& tile : make_tiles(scene, 0.5)) out += tile.surface == surface ? tile.area_m2 : 0;
    return out;
  };
  const dvec3 a{0, 0, 0}, b{8, 0, 0}, c{8, 8, 0}, d{0, 8, 0};
  const Patch other_diagonal{{{a, b, d}, {b, c, d}}, 0.5}, turned{{{a, c, b}, {a, d, c}}, 0.5};
  for (const Patch& again : {square(8, 0.5), other_diagonal, turned}) {
    const Scene scene = scene_of({square(8, 0.5), again});
    CHECK(area(scene, 0) == doctest::Approx(64));
    CHECK(area(scene, 1) == 0);
  }
  CHECK(area(scene_of({square(4, 0.2), square(8, 0.5)}), 1) == doctest::Approx(48));
  CHECK(area(scene_of({square(4, 0), square(8, 0.5)}), 1) == doctest::Approx(64));  // the first does not scatter
  CHECK(area(scene_of({square(8, 0.5), square(4, 0)}), 0) == doctest::Approx(64));
  CHECK(area(scene_of({square(8, 0.5), square(8, 0.5, 0.01)}), 1) == doctest::Approx(64));  // another plane
  const Patch beside{{{b, {16, 0, 0}, {16, 8, 0}}, {b, {16, 8, 0}, c}}, 0.5};
  CHECK(make_tiles(scene_of({square(8, 0.5), beside}), 0.5).size() ==
        2 * make_tiles(scene_of({square(8, 0.5)}), 0.5).size());
}
