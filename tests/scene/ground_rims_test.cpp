// SPDX-License-Identifier: Apache-2.0
// The rim of a ground in scenes where the ground is known; scenes are files, like a user's.
#include "scene/ground_sheets.hpp"

#include <fstream>

#include "scene/city.hpp"
#include "scene/info.hpp"
#include "scene/load.hpp"
#include "temporary_folder.hpp"
#include "wedge_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The edges that a scene's loader keeps of all edges that diffract.
struct Kept {
  size_t free, rims;
};

Scene scene_of(std::vector<RawMesh> meshes, std::vector<uint32_t> material = {}) {
  Scene scene = build(std::move(meshes), std::move(material));
  find_wedges(scene, EdgeSearch::of_scene);
  return scene;
}

Kept kept(std::vector<RawMesh> meshes, std::vector<uint32_t> material = {}) {
  const Scene scene = scene_of(std::move(meshes), std::move(material));
  return {free_count(scene), scene.report.ground_rims};
}

bool operator==(const Kept& a, const Kept& b) { return a.free == b.free && a.rims == b.rims; }

RawMesh sheet(double x0, double y0, double x1, double y1, double z = 0) {
  return quad({x0, y0, z}, {x1 - x0, 0, 0}, {0, y1 - y0, 0});
}

// Hills of 40 m on 100 m, steps of 2.5 m.
RawMesh hills_of_40_m() {
  RawMesh hills;
  const auto height = [](double x, double y) { return 20 * std::sin(x / 20) * std::cos(y / 25); };
  for (int y = 0; y <= 40; ++y)
    for (int x = 0; x <= 40; ++x) hills.vertices.emplace_back(2.5 * x, 2.5 * y, height(2.5 * x, 2.5 * y));
  for (uint32_t y = 0; y < 40; ++y)
    for (uint32_t x = 0; x < 40; ++x) {
      const uint32_t a = y * 41 + x;
      hills.triangles.push_back({a, a + 1, a + 42});
      hills.triangles.push_back({a, a + 42, a + 41});
    }
  return hills;
}

}  // namespace

TEST_CASE("the rim of a ground does not diffract, its houses do") {
  const RawMesh ground = sheet(-50, -50, 50, 50);
  for (const RawMesh& house : {box({-3, -2, 0}, {2, 4, 5}), box({-3, -2, 0}, {2, 4, 5}, false),
                               box({-3, -2, -1}, {2, 4, 5}), box({44, -2, -1}, {56, 4, 5})}) {
    const Scene s = scene_of({ground, house});
    CHECK(free_count(s) == 0);
    CHECK(s.report.ground_rims >= 4);
    CHECK(s.wedges.size() >= 8);
  }
  // A model is no world: the same sheet, as the floor of a vehicle, ends at its rim.
  CHECK(free_count(build({ground})) == 4);
}

TEST_CASE("what ends above a ground diffracts: screens, canopies, tables, bridges, walls that are no ground") {
  const RawMesh ground = sheet(-50, -50, 50, 50);
  CHECK(kept({ground, quad({0, 0, 0}, {0, 4, 0}, {0, 0, 2})}) == Kept{3, 4});  // a screen stands on the ground
  CHECK(kept({ground, sheet(0, 0, 8, 5, 4)}) == Kept{4, 4});                   // a canopy
  CHECK(kept({ground, sheet(-60, -4, 60, 4, 6)}) == Kept{4, 4});               // a bridge that goes on beyond it
  CHECK(kept({ground, sheet(-45, -45, 45, 45, 12)}) == Kept{4, 4});            // a roof over nearly all of it
  // Without a ground the same canopy is no ground beside houses, but what spans half of the scene is.
  CHECK(kept({box({-50, -50, -1}, {-40, -40, 9}), box({40, 40, -1}, {50, 50, 9}), sheet(0, 0, 8, 5, 4)}) == Kept{4, 0});
  CHECK(kept({box({-50, -50, -1}, {-40, -40, 9}), box({40, 40, -1}, {50, 50, 9}), sheet(-40, -40, 40, 40)}).rims == 4);
  // A leaning screen, by 44 and by 46 degrees.
  CHECK(kept({quad({0, 0, 0}, {10, 0, 0}, {0, 10, 10 * std::tan(44 * degree)})}) == Kept{0, 4});
  CHECK(kept({quad({0, 0, 0}, {10, 0, 0}, {0, 10, 10 * std::tan(46 * degree)})}) == Kept{4, 0});
}

TEST_CASE("grounds of several materials, of tiles that are not welded, with holes for houses, of hills") {
  CHECK(kept({sheet(0, 0, 10, 30), sheet(10, 0, 40, 30)}, {0, 1}) == Kept{0, 6});
  std::vector<RawMesh> tiles;  // in rows that are shifted, so that none shares an edge with one of another row
  for (int row = 0; row < 4; ++row)
    for (int i = 0; i < 4; ++i)
      tiles.push_back(sheet(25 * i + 7 * row, 25 * row, 25 * i + 25 + 7 * row, 25 * row + 25));
  const Kept tiled = kept(tiles);
  CHECK(tiled.free == 0);
  CHECK(tiled.rims > 8);
  // Four sheets around a hole, in which a house stands that does not touch them.
  const std::vector<RawMesh> around{sheet(-50, -50, 50, -5), sheet(-50, 5, 50, 50), sheet(-50, -5, -5, 5),
                                    sheet(5, -5, 50, 5), box({-4, -4, 0}, {4, 4, 9})};
  CHECK(kept(around).free == 0);
  const RawMesh hills = hills_of_40_m();
  const Scene terrain = scene_of({hills});
  CHECK(free_count(build({hills})) > 0);
  CHECK(free_count(terrain) == 0);
}

TEST_CASE("how many surfaces a ground has: flat ones one, houses on it or not, hills nearly one a triangle") {
  const RawMesh ground = sheet(-50, -50, 50, 50);
  CHECK(ground_surfaces(scene_of({ground})) == 1);
  CHECK(ground_surfaces(scene_of({ground, box({-3, -2, 0}, {2, 4, 5}), box({-30, -20, -1}, {-20, -4, 5})})) == 1);
  CHECK(ground_surfaces(scene_of({box({-3, -2, 0}, {2, 4, 5})})) == 1);  // its roof, or its floor
  CHECK(ground_surfaces(scene_of({sheet(0, 0, 10, 30), sheet(10, 0, 40, 30)}, {0, 1})) == 2);
  CHECK(ground_surfaces(scene_of({quad({0, 0, 0}, {10, 0, 0}, {0, 0, 5})})) == 0);  // a wall
  const size_t hills = ground_surfaces(scene_of({hills_of_40_m(), box({44, 40, -30}, {56, 60, 90})}));
  CHECK(hills > 2500);
  CHECK(hills <= 3200);
}

TEST_CASE("the loader knows scenes from models, and scene info says what it left out") {
  const TemporaryFolder folder;
  write_city(parse_city_options("--blocks 2x2"), folder.path());
  const auto file = folder.path() / "city.xml";
  const Scene scene = load_scene_file(file, {}), all = load_scene_file(file, {}, {}, 5.9e9, EdgeSearch::of_model);
  CHECK(free_count(scene) == 0);
  CHECK(free_count(all) == 4);
  CHECK(load_scene_file(file, {}, {}, 5.9e9, EdgeSearch::none).wedges.empty());
  CHECK(describe_scene(scene).find(", 4 edges at the rim of the ground\n") != std::string::npos);
}
