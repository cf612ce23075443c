// SPDX-License-Identifier: Apache-2.0
// Surfaces of several materials in one plane: the smaller one counts, once in every place, for every order of the file.
// The oracle tests which meshes contain random points.
#include "scene/covered_faces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <random>

#include "painted.hpp"
#include "scene/info.hpp"
#include "scene/tiles.hpp"

using namespace wavetracer;
using glm::dvec3;
using test::area_m2;
using test::box;
using test::build_painted;
using test::cells;
using test::holds;
using test::materials_at;
using test::Painted;
using test::quad;
using test::turned_over;

namespace {

// All orders of the parts give one material at each of many points of the first one: that of the last part that holds
// the point. Parts are given from the largest to the smallest, all in the plane of the first.
void check_in_all_orders(const std::vector<Painted>& parts, const dvec3& corner, const dvec3& u, const dvec3& v) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<dvec3> points;
  for (int i = 0; i < 500; ++i) points.push_back(corner + u * share(random) + v * share(random));
  std::vector<size_t> order(parts.size());
  std::iota(order.begin(), order.end(), size_t{0});
  do {
    std::vector<Painted> ordered;
    for (const size_t i : order) ordered.push_back(parts[i]);
    const Scene s = build_painted(ordered);
    for (const dvec3& p : points) {
      std::string expected;
      for (const Painted& part : parts)
        if (holds(part.mesh, p)) expected = part.material;
      CHECK(materials_at(s, p) == std::vector<std::string>{expected});
    }
  } while (std::ranges::next_permutation(order).found);
}

const RawMesh ground = quad({0, 0, 0}, {100, 0, 0}, {0, 80, 0});
const RawMesh road = quad({0, 31, 0}, {100, 2, 0}, {-1, 7, 0});  // across, and out of the ground on two sides

size_t wedges_at_height(const Scene& s, double z) {
  return static_cast<size_t>(
      std::ranges::count_if(s.wedges, [&](const Wedge& w) { return std::abs(w.start.z + s.origin_m.z - z) < 1e-6; }));
}

}  // namespace

TEST_CASE("a road drawn on the ground counts there, in either order, and a word says so") {
  check_in_all_orders({{ground, "soil"}, {road, "asphalt"}}, {0, 0, 0}, {100, 0, 0}, {0, 80, 0});
  const Scene s = build_painted({{ground, "soil"}, {road, "asphalt"}});
  const Scene turned = build_painted({{road, "asphalt"}, {ground, "soil"}});
  CHECK(s.surfaces.size() == 2);
  CHECK(area_m2(s, "asphalt") == doctest::Approx(702));
  CHECK(area_m2(s, "soil") + s.report.covered_m2 == doctest::Approx(8000));
  CHECK(area_m2(turned, "soil") == doctest::Approx(area_m2(s, "soil")).epsilon(1e-12));
  REQUIRE(s.report.warnings.size() == 1);
  CHECK(s.report.warnings == turned.report.warnings);
  CHECK(s.report.warnings[0].starts_with("surfaces of asphalt and soil lie on each other in one plane, on "));
  CHECK(s.report.warnings[0].find("asphalt counts there, because its surface is the smaller one") != std::string::npos);
  CHECK(describe_scene(s).find("m2 of surfaces, where a smaller one of another material lies") != std::string::npos);
}

TEST_CASE("planes stay what they were to the last bit, whichever way they are wound") {
  const glm::dquat turn = glm::angleAxis(0.4, glm::normalize(dvec3(1, 2, 5)));
  RawMesh wall = quad({0, 0, 0}, {20, 0, 0}, {0, 9, 0}), door = quad({4, 1, 0}, {1, 0, 0}, {0, 2, 0});
  for (RawMesh* m : {&wall, &door})
    for (dvec3& v : m->vertices) v = turn * v;
  const Scene alone = build_painted({{wall, "brick"}});
  for (const RawMesh& d : {door, turned_over(door)}) {
    const Scene s = build_painted({{d, "wood"}, {wall, "brick"}});
    REQUIRE(s.surfaces.size() == 2);
    CHECK(s.surfaces[1].normal == alone.surfaces[0].normal);
    CHECK(s.surfaces[1].offset_m == doctest::Approx(alone.surfaces[0].offset_m).epsilon(1e-12));
    CHECK(area_m2(s, "wood") == doctest::Approx(2));
    CHECK(area_m2(s, "brick") == doctest::Approx(178));
  }
  check_in_all_orders({{wall, "brick"}, {turned_over(door), "wood"}}, turn * dvec3(0, 0, 0), turn * dvec3(20, 0, 0),
                      turn * dvec3(0, 9, 0));
}

TEST_CASE("any triangulation of both, overlapping in part: each place once") {
  const dvec3 corner{0, 0, 2}, u{40, 0, 0}, v{0, 30, 0};
  check_in_all_orders(
      {{cells(corner, u, v, 7, 5), "soil"}, {cells({3.1, 2.3, 2}, {29, 11, 0}, {-4, 13, 0}, 6, 9), "gravel"}}, corner,
      u, v);
}

TEST_CASE("three materials on each other, the smallest on top of all") {
  check_in_all_orders({{ground, "soil"},
                       {quad({10, 10, 0}, {60, 0, 0}, {0, 50, 0}), "asphalt"},
                       {quad({30, 20, 0}, {10, 3, 0}, {-2, 9, 0}), "metal"}},
                      {0, 0, 0}, {100, 0, 0}, {0, 80, 0});
}

TEST_CASE("a ground of tiles that are not welded is as large as all of them") {
  std::vector<Painted> parts;
  for (int i = 0; i < 10; ++i) parts.push_back({quad({10.0 * i, 0, 0}, {10, 0, 0}, {0, 80.0 - i, 0}), "soil"});
  parts.push_back(
      {quad({0, 31, 0}, {100, 0, 0}, {0, 7, 0}), "asphalt"});             // 700 m2, a little less than one of the tiles
  parts.push_back({quad({0, 50, 0}, {100, 0, 0}, {0, 9, 0}), "gravel"});  // 900 m2, more than any of them
  const Scene s = build_painted(parts);
  CHECK(area_m2(s, "asphalt") == doctest::Approx(700));
  CHECK(area_m2(s, "gravel") == doctest::Approx(900));
  CHECK(s.report.covered_m2 == doctest::Approx(1600));
}

TEST_CASE("of equal areas the first name in the alphabet counts") {
  const RawMesh here = quad({0, 0, 0}, {10, 0, 0}, {0, 10, 0}), there = quad({5, 0, 0}, {10, 0, 0}, {0, 10, 0});
  for (const bool first : {true, false}) {
    const Scene s =
        first ? build_painted({{here, "wood"}, {there, "brick"}}) : build_painted({{there, "brick"}, {here, "wood"}});
    CHECK(area_m2(s, "brick") == doctest::Approx(100));
    CHECK(area_m2(s, "wood") == doctest::Approx(50));
    REQUIRE(s.report.warnings.size() == 1);
    CHECK(s.report.warnings[0].find("brick counts there, because both surfaces are equally large") !=
          std::string::npos);
  }
}

TEST_CASE("identical triangles of two materials follow the same rule") {
  for (const bool first : {true, false}) {
    const Scene s = first ? build_painted({{road, "wood"}, {turned_over(road), "brick"}})
                          : build_painted({{turned_over(road), "brick"}, {road, "wood"}});
    REQUIRE(s.surfaces.size() == 1);
    CHECK(s.materials[s.surfaces[0].material].name == "brick");
    CHECK(s.triangles.size() == 2);
    CHECK(s.vertices.size() == 4);
    CHECK(s.report.duplicate_triangles == 0);
    CHECK(s.report.warnings.size() == 1);
  }
}

TEST_CASE("nothing diffracts at the border of what was cut") {
  const Scene s = build_painted({{ground, "soil"},
                                 {quad({20, 30, 0}, {40, 3, 0}, {-1, 7, 0}), "asphalt"},
                                 {cells({50, 50, 0}, {30, 0, 0}, {0, 20, 0}, 4, 3), "gravel"}});
  CHECK(wedges_at_height(s, 0) == 4);  // the rim of the ground
  CHECK(test::total_length_m(s) == doctest::Approx(360));
  test::check_contract(s);
}

TEST_CASE("a door whose corners are rounded to float32 gets the plane of its wall, and its border is no bend") {
  const auto rounded = [](double along_m, double z_m) {
    const dvec3 p(100 + std::cos(0.5) * along_m, 70 + std::sin(0.5) * along_m, z_m);
    return dvec3(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  };
  const std::vector<Triangle> halves{{0, 1, 2}, {0, 2, 3}};
  const RawMesh wall = test::mesh({rounded(0, 0), rounded(20, 0), rounded(20, 9), rounded(0, 9)}, halves),
                door = test::mesh({rounded(4.1, 0.3), rounded(5.1, 0.3), rounded(5.1, 2.3), rounded(4.1, 2.3)}, halves);
  CHECK(build_painted({{door, "wood"}}).surfaces[0].normal != build_painted({{wall, "brick"}}).surfaces[0].normal);
  for (const Scene& s :
       {build_painted({{wall, "brick"}, {door, "wood"}}), build_painted({{door, "wood"}, {wall, "brick"}})}) {
    REQUIRE(s.surfaces.size() == 2);
    CHECK(s.surfaces[0].normal == s.surfaces[1].normal);
    CHECK(s.surfaces[0].offset_m == s.surfaces[1].offset_m);
    CHECK(s.wedges.size() == 4);  // the rim of the wall
  }
}

TEST_CASE("what is covered scatters once") {
  const auto scattering_m2 = [](const Scene& s) {
    double sum = 0;
    for (const Tile& tile : make_tiles(s, 2)) sum += tile.area_m2;
    return sum;
  };
  const RawMesh patch = quad({20, 30, 0}, {40, 3, 0}, {-1, 7, 0});
  for (const Scene& s : {build_painted({{ground, "soil"}, {patch, "asphalt"}}, 0.3),
                         build_painted({{patch, "asphalt"}, {ground, "soil"}}, 0.3)}) {
    CHECK(scattering_m2(s) == doctest::Approx(8000).epsilon(1e-9));
    CHECK(s.report.warnings.size() == 1);  // and no more of the triangles that lie on others
  }
}

TEST_CASE("places that nobody sees are settled without a word") {
  const RawMesh low = box({0, 0, 0}, {10, 10, 6}), high = box({10, 2, 0}, {20, 8, 9});
  const Scene houses = build_painted({{low, "brick"}, {high, "concrete"}});
  CHECK(houses.report.warnings.empty());
  CHECK(houses.report.covered_m2 == doctest::Approx(36));
  CHECK(area_m2(houses, "brick") == doctest::Approx(440 - 36));  // a wall of 60 m2, beside one of 54
  const Scene standing = build_painted({{ground, "soil"}, {low, "brick"}});
  CHECK(standing.report.warnings.empty());
  CHECK(standing.report.covered_m2 == doctest::Approx(100));
  CHECK(standing.report.nonmanifold_edges == 0);  // house and ground stay bodies of their own
  CHECK(area_m2(standing, "soil") == doctest::Approx(7900));
  // A door that is drawn on a house, and a box that is sunk into one up to its front, can be seen.
  CHECK(build_painted({{low, "brick"}, {quad({3, 0, 0}, {1, 0, 0}, {0, 0, 2}), "wood"}}).report.warnings.size() == 1);
  CHECK(build_painted({{low, "brick"}, {box({3, 0, 1}, {4, 1, 2}), "glass"}}).report.warnings.size() == 1);
}

TEST_CASE("volumes of vegetation are neither cut nor cut others") {
  const Scene s = build_painted({{ground, "soil"}, {box({10, 10, 0}, {20, 20, 5}), "leaves"}});
  REQUIRE(s.volumes.size() == 1);
  CHECK(s.volumes[0].triangles.size() == 12);
  CHECK(s.triangles.size() == 2);
  CHECK(s.report.warnings.empty());
}

TEST_CASE("surfaces that touch, or are 1 mm apart, or cross, do not overlap") {
  for (const RawMesh& other : {quad({100, 0, 0}, {50, 0, 0}, {0, 80, 0}), quad({10, 10, 1e-3}, {50, 0, 0}, {0, 50, 0}),
                               quad({10, 10, -1}, {50, 0, 0}, {0, 0, 2})}) {
    const Scene s = build_painted({{ground, "soil"}, {other, "asphalt"}});
    CHECK(s.triangles.size() == 4);
    CHECK(s.report.covered_m2 == 0);
    CHECK(s.report.warnings.empty());
  }
}
