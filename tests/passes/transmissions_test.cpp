// SPDX-License-Identifier: Apache-2.0
// transmissions: the rows of paths whose legs pass through walls, against brute force over all triangles in double.
// Walls 1 mm apart, walls in one place, borders, vehicles, limits.
#include "passes/transmissions.hpp"

#include <doctest/doctest.h>

#include "passes/image_method.hpp"
#include "passes/occlusion.hpp"
#include "passes/solved_rows.hpp"
#include "passes/traffic.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::vector<PathRow> pass(const DeviceScene& scene, const std::vector<PathRow>& rows, uint32_t most,
                          uint32_t max_depth) {
  SolvedList list = upload_rows(rows, max_depth);
  Transmissions transmissions(context(), scene, most);
  Counters counters(context());
  transmissions(scene, ends_of(rows), list, counters);
  return download_rows(list);
}

PathRow pass(const std::vector<Quad>& quads, const PathRow& row, uint32_t most = 8, uint32_t max_depth = 8) {
  const DeviceScene scene = make_device_scene(context(), reference::scene_of_quads(quads), false, 4000);
  return pass(scene, {row}, most, max_depth).front();
}

std::vector<uint32_t> through(const std::vector<Quad>& quads, const glm::dvec3& from, const glm::dvec3& to) {
  const PathRow row = pass(quads, {from, to, {}, {}});
  CHECK_FALSE(row.blocked);
  return row.steps;
}

uint32_t passed(uint32_t surface) { return WT_STEP_TRANSMISSION | surface; }

// Compares steps exactly, points to a nanometre.
void check_row(const PathRow& row, const PathRow& expected) {
  REQUIRE_FALSE(row.blocked);
  REQUIRE(row.steps == expected.steps);
  for (size_t k = 0; k < row.points.size(); ++k) CHECK(glm::distance(row.points[k], expected.points[k]) < 1e-9);
}

// Paths among quads: reflection points on them, and points beside them that belong to wedges and tiles.
std::vector<PathRow> random_rows(const std::vector<Quad>& quads, size_t count, Random& random) {
  std::vector<PathRow> rows(count);
  for (PathRow& row : rows) {
    row.from = random.in_cube(8);
    row.to = random.in_cube(8);
    for (uint32_t k = random.below(4); k > 0; --k) {
      const uint32_t number = random.below(static_cast<uint32_t>(quads.size()));
      const uint32_t kind = random.below(3);
      row.steps.push_back(number | (kind == 0   ? WT_STEP_REFLECTION
                                    : kind == 1 ? WT_STEP_DIFFRACTION
                                                : WT_STEP_SCATTERING));
      row.points.push_back(kind == 0 ? quads[number].corner + random() * quads[number].u + random() * quads[number].v
                                     : random.in_cube(8));
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("what random paths among random quads pass, in order, is what brute force finds") {
  Random random(3);
  const std::vector<Quad> quads = random_quads(24, 6, 5, random);
  const Scene scene = reference::scene_of_quads(quads);
  const DeviceScene uploaded = make_device_scene(context(), scene, false, 20);
  const std::vector<PathRow> rows = random_rows(quads, 150, random);
  const std::vector<PathRow> all = pass(uploaded, rows, WT_MAX_DEPTH, WT_MAX_DEPTH);
  const std::vector<PathRow> few = pass(uploaded, rows, 2, 4);
  SolvedList list = upload_rows(rows, 4);
  Occlusion occlusion(context(), uploaded);
  Counters counters(context());
  occlusion(uploaded, ends_of(rows), list, counters);
  const std::vector<PathRow> legs = download_rows(list), none = pass(uploaded, rows, 0, 4);
  size_t passing = 0, allowed = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    CAPTURE(i);
    const PathRow expected = with_crossings(scene, rows[i]);
    check_row(all[i], expected);
    const size_t count = expected.steps.size() - rows[i].steps.size();
    const bool fits = count <= 2 && expected.steps.size() <= 4;
    CHECK(few[i].blocked == !fits);
    if (fits) check_row(few[i], expected);
    CHECK(legs[i].blocked == (count > 0));  // the rule of occlusion is the same
    CHECK(none[i].blocked == (count > 0));
    passing += count;
    allowed += fits && count > 0;
  }
  CHECK(passing > 150);  // otherwise the test would prove nothing
  CHECK(allowed > 20);
}

TEST_CASE("walls 1 mm apart are two, in the order of the leg, also half a kilometre from the origin") {
  for (const glm::dvec3& far : {glm::dvec3{0}, glm::dvec3{500, -400, 30}}) {
    std::vector<Quad> walls{wall(0.001), wall(0), wall(-0.001)};
    for (Quad& w : walls) w.corner += far;
    const glm::dvec3 a = far + glm::dvec3{-3, 0.1, 0.2}, b = far + glm::dvec3{3, 0.3, -0.4};
    CHECK(through(walls, a, b) == std::vector{passed(2), passed(1), passed(0)});
    CHECK(through(walls, b, a) == std::vector{passed(0), passed(1), passed(2)});
  }
}

TEST_CASE("walls nearer each other than float32 tells apart are in order too") {
  const glm::dvec3 far{3000, 20, 30};  // 0.24 mm are one unit in the last place there
  std::vector<Quad> walls{wall(0.00045), wall(0.0003), wall(0.00015), wall(0)};
  for (Quad& w : walls) w.corner += far;
  const glm::dvec3 a = far + glm::dvec3{-3, 0.1, 0.2}, b = far + glm::dvec3{3, 0.3, -0.4};
  CHECK(through(walls, a, b) == std::vector{passed(3), passed(2), passed(1), passed(0)});
  CHECK(through(walls, b, a) == std::vector{passed(0), passed(1), passed(2), passed(3)});
}

TEST_CASE("walls in one place are one, whichever way they face") {
  Quad turned = wall(0);
  std::swap(turned.u, turned.v);
  const Quad larger{{0, -3, -5}, {0, 5, 0}, {0, 0, 9}};
  CHECK(through({wall(0), turned, larger}, {-3, 0.1, 0.2}, {3, 0.3, -0.4}).size() == 1);
  CHECK(through({wall(0), turned, larger, wall(1)}, {3, 0.3, -0.4}, {-3, 0.1, 0.2}).size() == 2);
  CHECK(through({wall(0), turned}, {-300, 0, 0}, {0.3, 0.01, 0}).size() == 1);
  // A tenth of the tolerance apart, along a leg that grazes both: still one wall.
  CHECK(through({wall(0), wall(1e-5)}, {-0.002, -1.9, 0}, {0.002, 1.9, 0}).size() == 1);
  // Walls that cross in the point are two.
  CHECK(through({wall(0), {{-2, -2, -2}, {4, 4, 0}, {0, 0, 4}}}, {-3, 0, 0}, {3, 0, 0}).size() == 2);
}

TEST_CASE("a shared border is passed once") {
  CHECK(through({wall(0)}, {-3, 0.5, 0.5}, {3, 0.5, 0.5}).size() == 1);  // the diagonal of two triangles
  const std::vector<Quad> halves{{{0, -2, -2}, {0, 2, 0}, {0, 0, 4}}, {{0, 0, -2}, {0, 2, 0}, {0, 0, 4}}};
  for (const double z : {-1.3, -0.4, 0.0, 0.7, 1.9})
    for (const double tilt : {0.0, 0.3}) CHECK(through(halves, {-3, 0, z - tilt}, {3, 0, z + tilt}).size() == 1);
}

TEST_CASE("an end on a wall, and the surfaces that a leg is reflected by, are not passed") {
  for (const double off : {0.0, 5e-5, -5e-5}) CHECK(through({wall(0)}, {-3, 0, 0}, {off, 0.1, 0.2}).empty());
  CHECK(through({wall(0)}, {-3, 0, 0}, {2e-4, 0.1, 0.2}).size() == 1);
  // A reflection lies behind its surface because of rounding; a wedge of that number hides nothing of its own.
  const glm::dvec3 from{-3, -1, 0}, to{-3, 1, 0}, behind{0.01, 0, 0};
  CHECK(pass({wall(0)}, {from, to, {0}, {behind}}).steps == std::vector{0u});
  CHECK(pass({wall(0)}, {from, to, {WT_STEP_DIFFRACTION}, {behind}}).steps ==
        std::vector{passed(0), WT_STEP_DIFFRACTION, passed(0)});
}

TEST_CASE("limits: transmissions of a path, and interactions of all kinds") {
  const std::vector<Quad> walls{wall(0), wall(1), wall(2)};
  const PathRow straight{{-3, 0.1, 0.2}, {5, 0.3, 0.4}, {}, {}};
  for (uint32_t most = 0; most < 5; ++most)
    for (uint32_t max_depth = 1; max_depth < 5; ++max_depth)
      CHECK(pass(walls, straight, most, max_depth).blocked == (most < 3 || max_depth < 3));
  // One before the vertex, two after it.
  const PathRow bent{{-3, 0.1, 0.2}, {5, 0.3, 0.4}, {WT_STEP_DIFFRACTION | 5}, {{0.5, 0.2, 0.1}}};
  CHECK(pass(walls, bent, 3, 3).blocked);
  CHECK(pass(walls, bent, 2, 4).blocked);
  CHECK(pass(walls, bent, 3, 4).steps == std::vector{passed(0), WT_STEP_DIFFRACTION | 5, passed(1), passed(2)});
}

TEST_CASE("a surface that nothing passes blocks, and no other does") {
  const DeviceScene scene = make_device_scene(context(), reference::scene_of_quads({wall(0), wall(1), wall(2)}), false,
                                              4000, {false, true, false});
  const auto blocked = [&](double from, double to) {
    return pass(scene, {{{from, 0.1, 0.2}, {to, 0.3, 0.4}, {}, {}}}, 8, 8).front().blocked;
  };
  CHECK_FALSE(blocked(-1, 0.5));
  CHECK_FALSE(blocked(1.5, 2.5));
  CHECK(blocked(0.5, 1.5));
  CHECK(blocked(-1, 2.5));
  CHECK(blocked(2.5, -1));
}

TEST_CASE("through vehicles as through the same triangles in the scene, but for the antennas' own") {
  const Traffic traffic(12, 31);
  const Scene baked = traffic.baked();
  const DeviceScene uploaded = traffic.upload();
  Random random(5);
  std::vector<PathRow> rows(120);
  for (PathRow& row : rows) {
    row.from = random.in_cube(10);
    row.to = random.in_cube(10);
  }
  const std::vector<PathRow> all = pass(uploaded, rows, WT_MAX_DEPTH, WT_MAX_DEPTH);
  size_t moving = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    CAPTURE(i);
    const PathRow expected = with_crossings(baked, rows[i]);
    REQUIRE(all[i].steps == expected.steps);
    for (size_t k = 0; k < all[i].steps.size(); ++k) {
      CHECK(glm::distance(all[i].points[k], expected.points[k]) < 1e-6);
      moving += (all[i].steps[k] & ~WT_STEP_KIND) >= traffic.still.size();
    }
  }
  CHECK(moving > 50);

  // Every path again, sent from one vehicle to another.
  const auto numbers = [&](uint32_t v) {
    const uint32_t first = traffic.instances[v].first_surface;
    return std::pair{first, first + static_cast<uint32_t>(traffic.bodies[traffic.instances[v].model].size())};
  };
  for (PathRow& row : rows) {
    row.from_instance = random.below(12);
    row.to_instance = random.below(12);
  }
  const std::vector<PathRow> own = pass(uploaded, rows, WT_MAX_DEPTH, WT_MAX_DEPTH);
  size_t fewer = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    std::vector<uint32_t> expected = all[i].steps;
    for (const uint32_t v : {rows[i].from_instance, rows[i].to_instance})
      std::erase_if(expected, [range = numbers(v)](uint32_t step) {
        return (step & ~WT_STEP_KIND) >= range.first && (step & ~WT_STEP_KIND) < range.second;
      });
    CHECK(own[i].steps == expected);
    fewer += expected.size() < all[i].steps.size();
  }
  CHECK(fewer > 5);
}
