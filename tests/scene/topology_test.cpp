// SPDX-License-Identifier: Apache-2.0
// Welding, cleaning, surfaces and edges, on meshes whose answers are known by hand.
// Euler's formula V - E + F = 2 checks closed meshes independently of the edge search.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/info.hpp"
#include "scene/topology.hpp"
#include "scene/weld.hpp"
#include "scene_files.hpp"
#include "wavetracer/error.hpp"
#include "wedge_check.hpp"

using namespace wavetracer;
using doctest::Contains;
using glm::dvec3;
using test::build;
using test::mesh;
using test::quad;

namespace {

Scene load_boxes(const std::vector<std::pair<dvec3, dvec3>>& boxes) {
  const test::TemporaryFolder folder;
  std::string xml = "<scene><bsdf type=\"diffuse\" id=\"itu_brick\"/>";
  for (size_t i = 0; i < boxes.size(); ++i) {
    const std::string name = "box" + std::to_string(i) + ".ply";
    folder.write(name, test::box_ply(boxes[i].first, boxes[i].second));
    xml += "<shape type=\"ply\"><string name=\"filename\" value=\"" + name + "\"/><ref id=\"itu_brick\"/></shape>";
  }
  return load_scene_file(folder.write("scene.xml", xml + "</scene>"), {});
}

// Checks the promises of every Scene, from its triangles.
void check_consistent(const Scene& s) {
  REQUIRE(s.triangle_surface.size() == s.triangles.size());
  REQUIRE(s.triangle_object.size() == s.triangles.size());
  std::vector<int> seen(s.triangles.size(), 0);
  uint32_t lowest_before = 0;
  for (uint32_t i = 0; i < s.surfaces.size(); ++i) {
    const Surface& f = s.surfaces[i];
    CHECK(glm::length(f.normal) == doctest::Approx(1).epsilon(1e-15));
    const uint32_t lowest = s.surface_triangles[f.first_triangle];
    CHECK((i == 0 || lowest > lowest_before));
    lowest_before = lowest;
    for (uint32_t k = 0; k < f.triangle_count; ++k) {
      const uint32_t t = s.surface_triangles[f.first_triangle + k];
      CHECK(s.triangle_surface[t] == i);
      ++seen[t];
      for (uint32_t v : s.triangles[t]) {
        CHECK(std::abs(glm::dot(f.normal, s.vertices[v]) - f.offset_m) <= flat_as_it_is_m);
        for (int axis = 0; axis < 3; ++axis) {
          CHECK(s.vertices[v][axis] >= f.lower[axis]);
          CHECK(s.vertices[v][axis] <= f.upper[axis]);
        }
      }
    }
  }
  CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  size_t faces = 0;
  for (const Edge& e : s.edges) {
    faces += e.face_count;
    for (uint32_t k = 0; k < e.face_count; ++k) {
      const auto& t = s.triangles[s.edge_faces[e.first_face + k]];
      for (uint32_t v : e.vertices) CHECK(std::count(t.begin(), t.end(), v) == 1);
    }
  }
  CHECK(faces == 3 * s.triangles.size());
}

}  // namespace

TEST_CASE("a box is 6 surfaces, closed") {
  const Scene s = load_boxes({{{0, 0, 0}, {4, 3, 2}}});
  check_consistent(s);
  CHECK(s.triangles.size() == 12);
  CHECK(s.surfaces.size() == 6);
  CHECK(s.report.free_edges == 0);
  CHECK(s.vertices.size() + s.triangles.size() - s.edges.size() == 2);
  CHECK(std::count_if(s.edges.begin(), s.edges.end(), [](const Edge& e) { return e.flat; }) == 6);  // the diagonals
  for (const Surface& f : s.surfaces) {  // exact axis normals, exact offsets
    CHECK(std::max({f.normal.x, f.normal.y, f.normal.z}) == 1);
    CHECK(f.normal.x + f.normal.y + f.normal.z == 1);
    CHECK(glm::dot(f.normal, f.lower) == f.offset_m);
  }
  CHECK(describe_scene(s).find("surfaces   6, the largest of 2 triangles") != std::string::npos);
}

TEST_CASE("boxes that touch are welded: shared edges, one facade, one wall between them") {
  const Scene s = load_boxes({{{0, 0, 0}, {4, 3, 2}}, {{4, 0, 0}, {8, 3, 2}}});
  check_consistent(s);
  CHECK(s.vertices.size() == 12);
  CHECK(s.report.free_edges == 0);
  CHECK(s.report.welded_vertices == 4);
  // The two faces between the boxes coincide, with their diagonals: one is kept, and each of its four sides meets two
  // facades.
  CHECK(s.report.duplicate_triangles == 2);
  CHECK(s.report.nonmanifold_edges == 4);
  CHECK(s.surfaces.size() == 7);
  // 4 facades across both boxes, 2 ends, and the wall between.
  CHECK(std::count_if(s.surfaces.begin(), s.surfaces.end(),
                      [](const Surface& f) { return f.upper.x - f.lower.x == 8; }) == 4);
}

TEST_CASE("UTM coordinates stay exact") {
  const dvec3 low(691608.12345678901, 5334760.98765432, 512.25), high = low + dvec3(10.5, 20.25, 3.125);
  const Scene s = load_boxes({{low, high}});
  CHECK(s.surfaces.size() == 6);
  for (int k = 0; k < 3; ++k) {
    CHECK(s.origin_m[k] == std::floor(s.origin_m[k]));
    CHECK(s.lower[k] + s.origin_m[k] == low[k]);
    CHECK(s.upper[k] + s.origin_m[k] == high[k]);
    CHECK(std::abs(s.lower[k]) < 11);
  }
}

TEST_CASE("welding: borders, chains, lowest representative, any order") {
  const double tolerance = 1e-3;
  std::vector<dvec3> points;  // pairs across cell borders in every direction, at large and negative coordinates
  for (double base : {0.0, -0.004, 0.008, 12345.004, -99999.996}) {
    for (int d = 1; d < 8; ++d) {
      const dvec3 at(base + d, base, base);
      points.push_back(at);
      points.push_back(at + dvec3(d & 1, (d >> 1) & 1, (d >> 2) & 1) * -5.7e-4);
    }
  }
  Weld weld = weld_vertices(points, tolerance);
  CHECK(weld.positions.size() == points.size() / 2);
  for (size_t i = 0; i < points.size(); i += 2) {
    CHECK(weld.vertex[i] == weld.vertex[i + 1]);
    CHECK(weld.positions[weld.vertex[i]] == points[i]);
  }
  std::reverse(points.begin(), points.end());
  CHECK(weld_vertices(points, tolerance).positions.size() == points.size() / 2);
  CHECK(weld_vertices(std::vector<dvec3>{{0, 0, 0}, {0.00101, 0, 0}}, tolerance).positions.size() == 2);
  // A chain is one vertex whatever its order.
  weld = weld_vertices(std::vector<dvec3>{{0, 0, 0}, {0.0018, 0, 0}, {0.0009, 0, 0}}, tolerance);
  CHECK(weld.positions == std::vector<dvec3>{{0, 0, 0}});
  CHECK(weld.widest_m == doctest::Approx(0.0018));
}

TEST_CASE("brute force agrees with the weld of random clusters") {
  std::vector<dvec3> points;
  uint64_t state = 1;
  const auto random = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 40) * 0x1p-24;
  };
  for (int i = 0; i < 600; ++i) points.push_back(dvec3(random(), random(), random()) * 0.02 - dvec3(0.01));
  std::vector<size_t> group(points.size());
  for (size_t i = 0; i < points.size(); ++i) group[i] = i;
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (glm::distance(points[i], points[j]) > 1e-3) continue;
      const size_t from = std::max(group[i], group[j]), to = std::min(group[i], group[j]);
      for (size_t& g : group) g = g == from ? to : g;
    }
  }
  const Weld weld = weld_vertices(points, 1e-3);
  for (size_t i = 0; i < points.size(); ++i) CHECK(weld.positions[weld.vertex[i]] == points[group[i]]);
}

TEST_CASE("degenerate and duplicate triangles are dropped and counted") {
  RawMesh a = quad({0, 0, 0}, {10, 0, 0}, {0, 10, 0});
  a.vertices.push_back({5, 1e-7, 0});     // vertex 4 lies on the edge 0-1, so (0, 1, 4) has no height
  a.vertices.push_back({10.0005, 0, 0});  // vertex 5 is welded with 1
  a.triangles.push_back({0, 1, 4});
  a.triangles.push_back({1, 5, 2});  // a side of zero after welding
  a.triangles.push_back({2, 1, 0});  // repeats the first, turned
  const Scene s = build({a, quad({0, 0, 0}, {10, 0, 0}, {0, 10, 0})}, {0, 1});
  CHECK(s.report.degenerate_triangles == 2);
  CHECK(s.report.duplicate_triangles == 1);  // triangles of another material are covered, or cover others
  CHECK(s.report.welded_vertices == 5);
  REQUIRE(s.report.warnings.size() == 1);
  CHECK(s.report.warnings[0].starts_with("surfaces of brick and concrete lie on each other in one plane"));
  CHECK(s.triangles.size() == 2);
  CHECK(s.vertices.size() == 4);
  CHECK(s.surfaces.size() == 1);
  CHECK(s.materials[s.surfaces[0].material].name == "brick");
  check_consistent(s);
}

TEST_CASE("surfaces end at materials, bends and gaps") {
  const RawMesh floor = quad({0, 0, 0}, {10, 0, 0}, {0, 10, 0});
  const RawMesh beside = quad({10, 0, 0}, {5, 0, 0}, {0, 10, 0});
  CHECK(build({floor, beside}).surfaces.size() == 1);
  const Scene two = build({floor, beside}, {0, 1});
  CHECK(two.surfaces.size() == 2);
  const auto shared = [](const Scene& s) {  // the edge between the two rectangles
    return *std::find_if(s.edges.begin(), s.edges.end(), [&](const Edge& e) {
      return e.face_count == 2 &&
             s.triangle_object[s.edge_faces[e.first_face]] != s.triangle_object[s.edge_faces[e.first_face + 1]];
    });
  };
  CHECK(shared(two).flat);  // coplanar, although of two materials
  CHECK(build({floor, quad({10.01, 0, 0}, {5, 0, 0}, {0, 10, 0})}).surfaces.size() == 2);
  const Scene bent = build({floor, quad({10, 0, 0}, {5, 0, 0.01}, {0, 10, 0})});  // 2 mrad
  CHECK(bent.surfaces.size() == 2);
  CHECK_FALSE(shared(bent).flat);
  CHECK(bent.surfaces[1].object == 1);
  // A flap folded back into the plane ends there: a knife edge, not a flat one.
  const Scene folded = build({mesh({{0, 0, 0}, {10, 0, 0}, {5, 8, 0}, {5, 4, 0}}, {{0, 1, 2}, {0, 1, 3}})});
  CHECK(folded.surfaces.size() == 1);
  CHECK(std::none_of(folded.edges.begin(), folded.edges.end(), [](const Edge& e) { return e.flat; }));
}

TEST_CASE("a fine cylinder does not drift into one surface; a sliver joins its wall") {
  RawMesh tube;
  const int sides =
      3600;  // bends of 1.7 mrad, facets 35 mm wide: all corners of a neighbour are within 2 mm of the plane
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / sides;
    tube.vertices.push_back({20 * std::cos(angle), 20 * std::sin(angle), 0});
    tube.vertices.push_back({20 * std::cos(angle), 20 * std::sin(angle), 5});
  }
  for (uint32_t i = 0; i < sides; ++i) {
    const uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    tube.triangles.push_back({a, b, b + 1});
    tube.triangles.push_back({a, b + 1, a + 1});
  }
  CHECK(build({tube}).surfaces.size() == sides);
  // A wall of two triangles, and a strip 4 mm high along its top whose far corner is 0.1 mm off the plane: 25 mrad.
  RawMesh wall = quad({0, 0, 0}, {10, 0, 0}, {0, 0, 3});
  wall.vertices.push_back({5, 1e-4, 3.004});
  wall.triangles.push_back({3, 2, 4});
  const Scene s = build({wall});
  CHECK(s.surfaces.size() == 1);
  CHECK(s.surfaces[0].normal == dvec3(0, 1, 0));  // the normal of the large triangles, whatever the strip's is
}

TEST_CASE("normals do not depend on the winding, ids not on anything but the lowest triangle") {
  RawMesh wall = quad({0, 0, 0}, {0, 4, 0}, {3, 0, 4});
  const Scene s = build({wall});
  for (Triangle& t : wall.triangles) std::swap(t[1], t[2]);
  const Scene turned = build({wall});
  CHECK(s.surfaces[0].normal == turned.surfaces[0].normal);
  CHECK(s.surfaces[0].normal.x == doctest::Approx(0.8).epsilon(1e-15));
}

TEST_CASE("impossible scenes") {
  CHECK_THROWS_WITH_AS(build({}), Contains("has no triangles"), InputError);
  CHECK_THROWS_WITH_AS(build({mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}})}),
                       Contains("all triangles of the scene are degenerate"), InputError);
  CHECK_THROWS_WITH_AS(build({quad({0, 0, 0}, {1e9, 0, 0}, {0, 1, 0})}), Contains("is scene.scale right"), InputError);
  CHECK_THROWS_WITH_AS(build({quad({5, 5, 5}, {0.099, 0, 0}, {0, 0.05, 0})}), Contains("less than 0.1 m"), InputError);
  CHECK(build({quad({5, 5, 5}, {1, 0, 0}, {0, 0.001, 0})}).report.warnings.empty());
  const Scene small = build({quad({0, 0, 0}, {0.101, 0, 0}, {0, 0.1, 0})});
  REQUIRE(small.report.warnings.size() == 1);
  CHECK(small.report.warnings[0].find("0.101 m only, and details of less than 1 cm") != std::string::npos);
  RawMesh dust;  // a model in kilometres: vertices a millimetre apart
  for (int i = 0; i < 40; ++i) dust.vertices.push_back({0.0005 * i, 0, 0});
  dust.vertices.push_back({0, 1, 0});
  dust.vertices.push_back({1, 0, 0});
  dust.triangles = {{0, 41, 40}};
  for (uint32_t i = 1; i < 40; ++i) dust.triangles.push_back({i - 1, i, 40});
  const Scene s = build({dust});
  CHECK(s.report.degenerate_triangles == 39);
  REQUIRE(s.report.warnings.size() == 1);
  CHECK(s.report.warnings[0].find("welded over 0.0195 m") != std::string::npos);
}
