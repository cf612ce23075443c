// SPDX-License-Identifier: Apache-2.0
// Flattening leaves shapes that are no planes unchanged: curves, steps, thin plates, bends; and its effect on coarse
// files.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cells.hpp"
#include "gltf_builder.hpp"
#include "scene/ply.hpp"
#include "scene_files.hpp"

using namespace wavetracer;
using glm::dvec3;
using test::build;
using test::cells;
using test::cells_tolerance_m;
using test::mesh;
using test::off_plane_m;
using test::road;

TEST_CASE("curves stay: of a tube nothing moves, a noisy curved road is flat pieces within the tolerance") {
  for (const auto& [radius_m, sides] : {std::pair{20.0, 3600}, {3.0, 90}, {0.5, 200}}) {
    RawMesh tube = mesh({}, {});
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * test::pi * (i + 0.3) / sides;
      for (const double z : {0.0, 2.0, 5.0})
        tube.vertices.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), z);
    }
    const auto n = static_cast<uint32_t>(sides);
    for (uint32_t i = 0; i < n; ++i) {
      for (uint32_t k = 0; k < 2; ++k) {
        const uint32_t a = 3 * i + k, b = 3 * ((i + 1) % n) + k;
        tube.triangles.push_back({a, b, b + 1});
        tube.triangles.push_back({a, b + 1, a + 1});
      }
    }
    const Scene s = build({tube}, {}, cells_tolerance_m);
    CHECK(s.surfaces.size() == n);
    CHECK(s.report.flattened_vertices == 0);
  }
  const Scene curved =
      build({cells({.decimals = 3}, [](double x, double) { return x * x / 2000; })}, {}, cells_tolerance_m);
  CHECK(curved.surfaces.size() >= 8);
  CHECK(curved.report.flattened_by_m <= cells_tolerance_m);
}

TEST_CASE("kerbs, chamfers and the sides of thin plates stay apart") {
  for (const double step_m : {2e-3, 3e-3, 5e-3, 0.1}) {
    CAPTURE(step_m);
    const RawMesh lower = cells({.along = 20, .across = 4, .noise_m = 1e-4}, road);
    RawMesh upper = cells({.along = 20, .across = 4, .noise_m = 1e-4, .seed = 5}, road, {0, 6, step_m});
    RawMesh riser = mesh({}, {});
    for (uint32_t i = 0; i <= 20; ++i) {
      riser.vertices.push_back(lower.vertices[i * 5 + 4]);
      riser.vertices.push_back(upper.vertices[i * 5]);
    }
    for (uint32_t i = 0; i < 20; ++i) {
      riser.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
      riser.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    }
    const Scene s = build({lower, upper, riser}, {}, cells_tolerance_m);
    std::set<uint32_t> roads;
    for (uint32_t t = 0; t < s.triangles.size(); ++t)
      if (s.triangle_object[t] < 2) roads.insert(s.triangle_surface[t]);
    CHECK(roads.size() == 2);
    CHECK(s.triangle_surface.front() != s.triangle_surface[lower.triangles.size()]);
  }
  for (const double thick_m : {2.1e-3, 3e-3}) {  // a sign: nothing of it moves, both sides are there
    const Scene plate = build({test::box({0, 0, 2}, {0.6, thick_m, 2.6})}, {}, cells_tolerance_m);
    CHECK(plate.surfaces.size() == 6);
    CHECK(plate.report.flattened_vertices == 0);
  }
}

TEST_CASE("walls bent by less than the tolerance are one, others keep their bend; what is exact keeps its bits") {
  const auto bent = [](double off_m) {
    RawMesh wall = mesh({{0, 0, 0}, {20, 0, 0}, {40, off_m, 0}, {0, 0, 9}, {20, 0, 9}, {40, off_m, 9}},
                        {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
    return build({wall}, {}, cells_tolerance_m);
  };
  CHECK(bent(0.002).surfaces.size() == 1);
  CHECK(off_plane_m(bent(0.002)) < 1e-12);
  const Scene two = bent(0.02);
  CHECK(two.surfaces.size() == 2);
  CHECK(two.report.flattened_vertices == 0);
  CHECK(std::count_if(two.edges.begin(), two.edges.end(), [](const Edge& e) { return e.face_count == 2 && !e.flat; }) ==
        1);
  const std::vector<RawMesh> exact{test::l_building(), test::box({10.1, 3.7, 0}, {17.3, 9.9, 12.2})};
  const Scene with = build(exact, {}, cells_tolerance_m), without = build(exact);
  CHECK(with.vertices == without.vertices);
  REQUIRE(with.surfaces.size() == without.surfaces.size());
  for (size_t i = 0; i < with.surfaces.size(); ++i) {
    CHECK(with.surfaces[i].normal == without.surfaces[i].normal);
    CHECK(with.surfaces[i].offset_m == without.surfaces[i].offset_m);
  }
}

TEST_CASE("a facade in float32 at 691 km is one wall, and the scene says how coarse it is") {
  const test::TemporaryFolder folder;
  std::vector<dvec3> vertices;
  std::vector<Triangle> triangles;
  const double along_x = std::cos(33 * test::degree), along_y = std::sin(33 * test::degree);
  for (uint32_t i = 0; i <= 40; ++i)
    for (uint32_t j = 0; j < 5; ++j)
      vertices.emplace_back(691000 + 1.5 * i * along_x, 691000 + 1.5 * i * along_y, 3.0 * j);
  for (uint32_t i = 0; i < 40; ++i) {
    for (uint32_t j = 0; j < 4; ++j) {
      const uint32_t a = i * 5 + j;
      triangles.push_back({a, a + 5, a + 6});
      triangles.push_back({a, a + 6, a + 1});
    }
  }
  const Scene s = load_scene_file(folder.write("wall.ply", format_ply(vertices, triangles)), test::of_concrete());
  CHECK(s.surfaces.size() == 1);
  CHECK(s.report.plane_tolerance_m == 0.0625);
  CHECK(s.report.flattened_by_m < 0.0625);
  REQUIRE(s.report.warnings.size() == 1);
  CHECK(s.report.warnings[0].find("as coarse as 62 mm") != std::string::npos);
  SceneConfig exact = test::of_concrete();
  exact.plane_tolerance_m = 0;
  CHECK(load_scene_file(folder.path() / "wall.ply", exact).surfaces.size() > 10);
}

TEST_CASE("glTF: meshes are as coarse as float32 at their reach, by the scale of their node") {
  test::Gltf far;
  const nlohmann::json primitive = {
      {"attributes", {{"POSITION", far.positions({691000, 0, 0, 691001, 0, 0, 691000, 1, 0})}}}};
  far.mesh(primitive, {{"children", {1}}});
  far.add("nodes", {{"mesh", 0}, {"scale", {2, 0.5, 4}}});
  const RawScene two = far.read();
  REQUIRE(two.meshes.size() == 2);
  CHECK(two.meshes[0].rounding == 0.03125);  // 2^19 <= 691000 < 2^20: half a step of 24 binary digits
  CHECK(two.meshes[1].rounding == 0.125);

  test::Gltf near;
  near.mesh({{"attributes", {{"POSITION", near.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}},
            {{"translation", {691000, 0, 0}}});  // in double
  const RawScene one = near.read();
  REQUIRE(one.meshes.size() == 1);
  CHECK(one.meshes[0].rounding == 0x1p-24);
}
