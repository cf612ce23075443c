// SPDX-License-Identifier: Apache-2.0
// Polygons with holes against closed forms: areas, no overlap, every border edge once, faults by name.
#include "imports/triangulate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <random>

#include "imports/scene_files.hpp"

using namespace wavetracer;
using namespace wavetracer::imports;

namespace {

Ring ring(std::vector<glm::dvec2> points) { return make_ring(points); }
Ring square(double x, double y, double side) {
  return ring({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}});
}
std::vector<Point> corners(const Polygon& polygon) {
  std::vector<Point> out = polygon.outer;
  for (const Ring& hole : polygon.holes) out.insert(out.end(), hole.begin(), hole.end());
  return out;
}

// No triangle may be flat or turned, their number must be that of Euler's formula, and areas must add up exactly. Then
// they cannot overlap, since all lie inside: no edge of theirs crosses an edge of the polygon.
void check_triangles(Polygon polygon) {
  orient(polygon);
  REQUIRE(fault(polygon) == "");
  const std::vector<Point> points = corners(polygon);
  const std::vector<Triangle> triangles = triangulate(polygon);
  REQUIRE(triangles.size() == points.size() + 2 * polygon.holes.size() - 2);
  int64_t sum = 0;
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const Triangle& t : triangles) {
    const int64_t area = turn(points[t[0]], points[t[1]], points[t[2]]);
    CHECK(area > 0);
    sum += area;
    for (size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  CHECK(static_cast<double>(sum) / (2.0 * grid_per_m * grid_per_m) == area_m2(polygon));
  uint32_t first = 0;
  size_t border = 0;
  const auto check_border = [&](const Ring& r) {
    const auto n = static_cast<uint32_t>(r.size());
    for (uint32_t i = 0; i < n; ++i) {
      CHECK(edges[{first + i, first + (i + 1) % n}] == 1);
      CHECK(edges.count({first + (i + 1) % n, first + i}) == 0);
    }
    first += n;
    border += n;
  };
  check_border(polygon.outer);
  for (const Ring& hole : polygon.holes) check_border(hole);
  size_t inner = 0;
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    inner += edges.count({edge.second, edge.first});
  }
  CHECK(edges.size() == border + inner);     // every inner edge has its opposite
  for (const auto& [edge, count] : edges) {  // diagonals stay inside
    for (size_t i = 0; i <= polygon.holes.size(); ++i) {
      const Ring& r = i == 0 ? polygon.outer : polygon.holes[i - 1];
      for (size_t k = 0; k < r.size(); ++k) {
        const Point &p = r[k], &q = r[(k + 1) % r.size()], &a = points[edge.first], &b = points[edge.second];
        if (p == a || p == b || q == a || q == b) continue;
        CHECK_FALSE(segments_meet(a, b, p, q));
      }
    }
  }
}

// A star-shaped ring of n corners with radii between r and R.
Ring star(std::mt19937& random, int n, double x, double y, double r, double R) {
  std::uniform_real_distribution<double> radius(r, R);
  std::vector<glm::dvec2> points;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n, length = radius(random);
    points.emplace_back(x + length * std::cos(angle), y + length * std::sin(angle));
  }
  return make_ring(points);
}

}  // namespace

TEST_CASE("triangles of plain, concave and holed polygons cover them once") {
  check_triangles({square(0, 0, 10), {}});
  check_triangles({ring({{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}}), {}});
  check_triangles({ring({{0, 0}, {5, 0}, {10, 0}, {10, 5}, {10, 10}, {0, 10}}), {}});  // corners in straight walls
  check_triangles({square(0, 0, 10), {square(3, 3, 4)}});
  check_triangles({square(0, 0, 30), {square(3, 3, 4), square(13, 3, 4), square(3, 13, 4), square(13, 13, 4)}});
  check_triangles({square(0, 0, 10), {square(1. / 1024, 1. / 1024, 5)}});  // a wall of 1 mm
  Polygon grid{square(0, 0, 100), {}};  // holes that are level with one another: bridges over many equal corners
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) grid.holes.push_back(square(2 + 10 * i, 2 + 10 * j, 8));
  }
  check_triangles(grid);
}

TEST_CASE("triangles of random stars with star-shaped holes") {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    Polygon polygon{star(random, 3 + round * 2, 0, 0, 60, 100), {}};
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        if (round % 3 != 0 && (i + j) % 2 == 0)
          polygon.holes.push_back(star(random, 5 + round % 7, 18 * i, 18 * j, 2, 8));
      }
    }
    if (fault(polygon).empty()) check_triangles(polygon);  // with few corners the outline may cut its holes
  }
}

TEST_CASE("a spiral and a comb of 4900 corners, which have few ears at a time, take no cube of their number") {
  std::vector<glm::dvec2> spiral, comb;
  for (const int side : {0, 1})
    for (int k = 0; k < 2450; ++k) {
      const int i = side == 0 ? k : 2449 - k;
      const double angle = i * 0.05, radius_m = 20 + 4 * side + 0.7 * i;
      spiral.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
    }
  for (int i = 0; i < 4900; ++i) comb.emplace_back(i % 4 == 0 || i % 4 == 3 ? 0 : 3000, i / 2 * 0.5);
  comb.insert(comb.end(), {{-5, 1225}, {-5, -5}});
  for (const auto& outline : {spiral, comb}) {
    Polygon polygon{ring(outline), {}};
    orient(polygon);
    REQUIRE(fault(polygon) == "");
    const std::clock_t start = std::clock();
    const std::vector<Triangle> triangles = triangulate(polygon);
    // It took 20 s when every ear was searched again.
    CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 3);
    CHECK(triangles.size() == polygon.outer.size() - 2);
    int64_t sum = 0;
    for (const Triangle& t : triangles) sum += turn(polygon.outer[t[0]], polygon.outer[t[1]], polygon.outer[t[2]]);
    CHECK(sum == twice_area(polygon.outer));
  }
}

TEST_CASE("the area of a polygon of 2000 corners is that of its circle") {
  std::vector<glm::dvec2> points;
  for (int i = 0; i < 2000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 2000;
    points.emplace_back(500 * std::cos(angle), 500 * std::sin(angle));
  }
  Polygon circle{make_ring(points), {square(-100, -100, 200)}};
  orient(circle);
  CHECK(triangulate(circle).size() == 2004);
  const double exact = 1000 * 500.0 * 500.0 * std::sin(2 * std::numbers::pi / 2000) - 200 * 200;
  CHECK(area_m2(circle) == doctest::Approx(exact).epsilon(1e-6));  // corners on a grid of 1 mm
}

TEST_CASE("an extruded building is closed, looks outwards and has its volume") {
  Solid solid{"way_1", "", false, {square(0, 0, 10), {square(3, 3, 4)}}, {}, {0, 12, "concrete", "concrete"}};
  orient(solid.polygon);
  solid.triangles = triangulate(solid.polygon);
  for (const bool two_meshes : {false, true}) {
    solid.shape.roof = two_meshes ? "metal" : "concrete";
    const std::vector<SceneMesh> meshes = extrude(solid);
    REQUIRE(meshes.size() == (two_meshes ? 2 : 1));
    double six_volumes = 0;
    std::map<std::array<double, 6>, int> edges;
    for (const SceneMesh& mesh : meshes) {
      for (const Triangle& t : mesh.triangles) {
        std::array<glm::dvec3, 3> p;
        for (size_t k = 0; k < 3; ++k) p[k] = mesh.vertices[t[k]];
        six_volumes += p[0].x * (p[1].y * p[2].z - p[1].z * p[2].y) + p[0].y * (p[1].z * p[2].x - p[1].x * p[2].z) +
                       p[0].z * (p[1].x * p[2].y - p[1].y * p[2].x);
        for (size_t k = 0; k < 3; ++k) {
          const auto &a = p[k], &b = p[(k + 1) % 3];
          ++edges[{a.x, a.y, a.z, b.x, b.y, b.z}];
        }
      }
    }
    CHECK(six_volumes / 6 == (100 - 16) * (12 + foundation_m));
    for (const auto& [e, count] : edges) {
      CHECK(count == 1);
      CHECK(edges.count({e[3], e[4], e[5], e[0], e[1], e[2]}) == 1);
    }
  }
}

TEST_CASE("what is no polygon is told by its fault") {
  const Ring bow = ring({{0, 0}, {10, 10}, {10, 0}, {0, 10}});
  const Ring eight = ring({{0, 0}, {5, 5}, {10, 0}, {10, 10}, {5, 5}, {0, 10}});
  const Ring spike = ring({{0, 0}, {10, 0}, {20, 0}, {10, 0}, {10, 10}, {0, 10}});
  for (const Ring& bad : {bow, eight, spike}) {
    Polygon polygon{bad, {}};
    orient(polygon);
    CHECK(fault(polygon) != "");
  }
  CHECK(fault({ring({{0, 0}, {1, 1}}), {}}) == "fewer than three corners");
  CHECK(fault({ring({{0, 0}, {1, 1}, {2, 2}}), {}}) == "no area");
  CHECK(fault({Ring{}, {}}) == "fewer than three corners");
  CHECK(fault({square(0, 0, 10), {square(20, 20, 5)}}) == "a courtyard outside of the building");
  CHECK(fault({square(0, 0, 10), {square(5, 5, 10)}}) == "a courtyard outside of the building");
  CHECK(fault({square(0, 0, 10), {square(0, 2, 5)}}) == "outline that crosses or touches itself");
  CHECK(fault({square(0, 0, 20), {square(2, 2, 10), square(4, 4, 2)}}) == "a courtyard inside of another");
  CHECK(fault({square(0, 0, 20), {Ring{}}}) == "a courtyard of fewer than three corners");
  CHECK(fault({square(0, 0, 5000), {}}) == "larger than 4 km");
  CHECK(fault({square(1e9, 0, 5), {}}) == "too far from the middle of the map");
  CHECK(fault({Ring(6000), {}}) == "more than 5000 corners");
}
