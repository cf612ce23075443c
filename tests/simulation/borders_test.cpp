// SPDX-License-Identifier: Apache-2.0
// Tests that no path is found twice or lost where a reflection point lies on a border: of two patches, two triangles,
// two walls. Coordinates are numbers that float32 holds, so the points are on the border to the last bit or next to it.
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Returns the two-ray paths over two patches that meet at x = 0.
Paths over_patches(const std::string& west, const std::string& east, const glm::dvec3& tx, const glm::dvec3& rx) {
  const SceneFile file(
      {Part{{{{-10, -10, 0}, {10, 0, 0}, {0, 20, 0}}}, west}, Part{{{{0, -10, 0}, {10, 0, 0}, {0, 20, 0}}}, east}});
  return run(config_of(file.path(), {tx}, {rx}, 20000, 3)).paths;
}

}  // namespace

TEST_CASE("on the shared edge of two patches of different material: one path") {
  for (const double height : {1.0, 0.3, 1.7}) {
    CAPTURE(height);
    const Paths paths = over_patches("metal", "concrete", {-2, 0.5, height}, {2, -0.25, height});
    REQUIRE(paths.size() == 2);
    CHECK(paths.depth == std::vector<uint32_t>{0, 1});
    CHECK(glm::distance(paths.vertex_position_m[0], glm::dvec3(0, 0.125, 0)) < 1e-12);
  }
  // From the other side the same patch reflects, so gains are reciprocal.
  const Paths there = over_patches("metal", "concrete", {-2, 0.5, 1}, {2, -0.25, 1});
  const Paths back = over_patches("metal", "concrete", {2, -0.25, 1}, {-2, 0.5, 1});
  REQUIRE(there.size() == 2);
  REQUIRE(back.size() == 2);
  CHECK(back.vertex_surface == there.vertex_surface);
  CHECK(back.gain_db[1] == doctest::Approx(there.gain_db[1]).epsilon(1e-9));
}

TEST_CASE("on the shared edge of two patches of one material, and on the diagonal of a quad: one path") {
  CHECK(over_patches("metal", "metal", {-2, 0.5, 1}, {2, -0.25, 1}).size() == 2);
  // Each patch is two triangles; their diagonals run from (-10, -10) and (0, -10).
  for (const double t : {0.125, 0.3, 0.5, 0.7}) {
    const glm::dvec3 on_diagonal{-10 + 10 * t, -10 + 20 * t, 0}, across{2, -1, 0};
    CHECK(over_patches("metal", "concrete", on_diagonal + across / 4.0 + glm::dvec3(0, 0, 1),
                       on_diagonal - across / 4.0 + glm::dvec3(0, 0, 1))
              .size() == 2);
  }
}

TEST_CASE("two coincident walls: one path, of the smaller surface") {
  // The larger wall remains where the smaller one does not cover it.
  const SceneFile file({Part{{{{0, -5, -5}, {0, 10, 0}, {0, 0, 10}}}, "metal"},
                        Part{{{{0, -3, -4}, {0, 9, 0}, {0, 0, 8}}}, "concrete"}});
  Simulation simulation(config_of(file.path(), {{-3, 0.3, 0.2}}, {{-2, -0.4, 0.7}}, 20000, 4));
  REQUIRE(simulation.scene().surfaces.size() == 2);
  const Paths paths = simulation.run_frame(0).paths;
  CHECK(paths.size() == 2);
  CHECK(paths.vertex_surface == std::vector<uint32_t>{1});
}

TEST_CASE("between coincident walls facing each other: every order once") {
  // A corridor whose walls are there twice.
  const Quad left{{-200, 0, -100}, {400, 0, 0}, {0, 0, 200}}, right{{-200, 4, -100}, {400, 0, 0}, {0, 0, 200}};
  const Quad left_again{{-100, 0, -80}, {250, 0, 0}, {0, 0, 150}}, right_again{{-90, 4, -70}, {240, 0, 0}, {0, 0, 160}};
  const SceneFile file({Part{{left, right}, "metal"}, Part{{left_again, right_again}, "concrete"}});
  const Paths paths = run(config_of(file.path(), {{0, 1.125, 0.5}}, {{7, 2.75, -0.25}}, 100000, 4)).paths;
  CHECK(count_by_depth(paths, 0, 4) == std::vector<size_t>{1, 2, 2, 2, 2});
  CHECK(duplicates(paths) == 0);
}

TEST_CASE("a wall of many patches seen at grazing incidence: one reflection an order") {
  std::vector<Part> parts;
  for (int i = 0; i < 20; ++i)
    parts.push_back(Part{{{{-10.0 + i, 0, -5}, {1, 0, 0}, {0, 0, 10}}}, i % 2 ? "metal" : "concrete"});
  const SceneFile file(parts);
  // The point lies on the border of two patches, x = 0, and in the middle of one.
  for (const double x : {0.0, 0.5}) {
    const Paths paths = run(config_of(file.path(), {{x - 9, 0.25, 0.5}}, {{x + 9, 0.25, 0.25}}, 100000, 4)).paths;
    CHECK(count_by_depth(paths, 0, 4) == std::vector<size_t>{1, 1, 0, 0, 0});
  }
}
