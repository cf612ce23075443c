// SPDX-License-Identifier: Apache-2.0
// Tests the scenes of Sionna RT, where the folder with them exists: counts, and the time that munich takes. The
// expected counts of munich come from a separate count of its PLY files (exact positions rounded to the weld
// tolerance).
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "folders.hpp"
#include "scene/load.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

namespace {

const std::filesystem::path scenes = std::filesystem::path(test::shared_folder()) / "scenes";

bool absent() {
  if (std::filesystem::exists(scenes)) return false;
  MESSAGE("skipped: no folder ", scenes.string(), " (CMake option WAVETRACER_SHARED)");
  return true;
}

Scene load(const std::string& name) { return load_scene_file(scenes / name / (name + ".xml"), {}); }

}  // namespace

TEST_CASE("small shared scenes") {
  if (absent()) return;
  struct Expected {
    const char* name;
    size_t triangles, surfaces, free_edges;
  };  // six houses stand on the ground of the canyons, and their floors are cut out of it
  constexpr Expected expected[] = {{"box", 12, 6, 0},
                                   {"box_one_screen", 14, 7, 4},
                                   {"box_two_screens", 16, 8, 8},
                                   {"floor_wall", 4, 2, 8},
                                   {"simple_reflector", 2, 1, 4},
                                   {"double_reflector", 4, 2, 8},
                                   {"triple_reflector", 6, 3, 12},
                                   {"simple_wedge", 4, 2, 6},
                                   {"simple_street_canyon", 108, 37, 70},
                                   {"simple_street_canyon_with_cars", 268, 101, 70}};
  for (const Expected& e : expected) {
    CAPTURE(e.name);
    const Scene scene = load(e.name);
    CHECK(scene.triangles.size() == e.triangles);
    CHECK(scene.surfaces.size() == e.surfaces);
    CHECK(scene.report.free_edges == e.free_edges);
    CHECK(scene.report.nonmanifold_edges == 0);
    CHECK(scene.report.warnings.empty());
  }
  CHECK(load("box").materials[0].thickness_m == 1);
}

TEST_CASE("munich") {
  if (absent()) return;
  const Scene scene = load("munich");
  CHECK(scene.objects.size() == 2367);
  CHECK(scene.triangles.size() == 39001);
  CHECK(scene.edges.size() == 62175);
  CHECK(scene.report.free_edges == 7373);
  CHECK(scene.report.nonmanifold_edges == 13);
  CHECK(scene.surfaces.size() > 17000);
  CHECK(scene.surfaces.size() < 17432);  // number of surfaces without the rule for slivers
  CHECK(scene.materials.size() == 5);
  REQUIRE(scene.report.warnings.size() == 1);  // marble facades and metal ones coincide
  CHECK(scene.report.warnings[0].starts_with("surfaces of marble and metal lie on each other in one plane, on 442 m2"));
}

TEST_CASE("edges of the shared scenes that diffract") {
  if (absent()) return;
  const auto free_count = [](const Scene& s) {
    return std::count_if(s.wedges.begin(), s.wedges.end(), [](const Wedge& w) { return w.surface[0] == w.surface[1]; });
  };
  const Scene wedge = load("simple_wedge");
  CHECK(wedge.wedges.size() == 7);
  CHECK(free_count(wedge) == 6);
  // Six boxes stand on the ground: 8 edges each. Rims of grounds do not diffract.
  const Scene canyon = load("simple_street_canyon");
  CHECK(canyon.wedges.size() == 6 * 8);
  CHECK(canyon.report.ground_rims == 4);
  CHECK(canyon.report.corner_pieces >=
        6 * 4);  // edges are in pieces where borders of cut-out parts meet the feet of houses
  CHECK(load("box_one_screen").wedges.size() == 12 + 4);
  CHECK(load("floor_wall").wedges.size() == 4);  // the wall hangs above the floor
  // Buildings without floors: their feet are free edges of the mesh, and do not diffract where they meet the ground.
  const Scene munich = load("munich");
  const auto convex = std::ranges::count_if(munich.wedges, [](const Wedge& w) { return w.exterior_rad > 3.1416; });
  CHECK(convex > 25000);
  CHECK(convex < 35000);
  CHECK(munich.wedges.size() < 65000);  // corners of houses, seen from inside, and between houses
  CHECK(free_count(munich) < 1000);
  CHECK(munich.report.corner_pieces > 6000);
}

TEST_CASE("a vehicle body without a material") {
  if (absent()) return;
  SceneConfig config;
  CHECK_THROWS_AS(load_scene_file(scenes / "low_poly_car.ply", config), InputError);
  config.default_material = "metal";
  const Scene car = load_scene_file(scenes / "low_poly_car.ply", config);
  CHECK(car.triangles.size() == 20);
  CHECK(car.report.free_edges == 0);
}
