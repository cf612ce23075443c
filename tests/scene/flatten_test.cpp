// SPDX-License-Identifier: Apache-2.0
// Planes whose coordinates were rounded or measured become planes again; steps, curves and thin plates stay. The planes
// from which meshes were made are the truth: no test uses the fit for it.
#include "scene/flatten.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "cells.hpp"

using namespace wavetracer;
using glm::dvec3;
using test::build;
using test::cells;
using test::cells_tolerance_m;
using test::Height;
using test::mesh;
using test::off_plane_m;
using test::road;

namespace {

bool all_flat(const Scene& s) {
  return std::all_of(s.edges.begin(), s.edges.end(), [](const Edge& e) { return e.flat || e.face_count == 1; });
}

}  // namespace

TEST_CASE("a sloping road with few decimals, or with noise, is one plane near the true one") {
  for (const auto& [decimals, noise_m] :
       {std::pair{6, 0.0}, {5, 0.0}, {4, 0.0}, {3, 0.0}, {9, 1e-4}, {9, 3e-4}, {3, 3e-4}}) {
    CAPTURE(decimals);
    CAPTURE(noise_m);
    const Scene s = build({cells({.decimals = decimals, .noise_m = noise_m}, road)}, {}, cells_tolerance_m);
    REQUIRE(s.surfaces.size() == 1);
    CHECK(all_flat(s));
    CHECK(off_plane_m(s) <= (s.report.flattened_vertices > 0 ? 1e-12 : 1e-4));
    CHECK(s.report.flattened_by_m <= cells_tolerance_m);
    CHECK(s.report.bent_triangles == 0);
    double worst_m = 0;
    for (const dvec3& v : s.vertices) {
      const dvec3 p = s.origin_m + v;
      worst_m = std::max(worst_m, std::abs(p.z - road(p.x, p.y)));
    }
    CHECK(worst_m < 1.5e-4);
  }
  // Triangles beyond the tolerance are not called one plane.
  CHECK(build({cells({.noise_m = 3e-3}, road)}, {}, cells_tolerance_m).surfaces.size() > 100);
  const Scene as_it_is = build({cells({.decimals = 3}, road)}, {}, 0);
  CHECK(as_it_is.surfaces.size() > 10);
  CHECK(as_it_is.report.flattened_vertices == 0);
}

TEST_CASE("planes do not depend on the order of triangles and vertices, nor on the place of the scene") {
  const Height crown = [](double x, double y) { return 0.013 * x - 0.02 * std::abs(y - 6); };
  const RawMesh there = cells({.decimals = 3, .noise_m = 2e-4}, crown);
  const Scene first = build({there}, {}, cells_tolerance_m);
  CHECK(first.surfaces.size() == 2);
  RawMesh turned = there;
  std::mt19937 random(7);
  std::vector<uint32_t> number(there.vertices.size());
  for (uint32_t i = 0; i < number.size(); ++i) number[i] = i;
  std::shuffle(number.begin(), number.end(), random);
  for (uint32_t i = 0; i < number.size(); ++i) turned.vertices[number[i]] = there.vertices[i];
  for (Triangle& t : turned.triangles) {
    for (uint32_t& v : t) v = number[v];
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    if (random() % 2) std::swap(t[0], t[1]);
  }
  std::shuffle(turned.triangles.begin(), turned.triangles.end(), random);
  RawMesh far = there;
  for (dvec3& v : far.vertices) v += dvec3(691000.37, 5334000.21, 517.93);
  const Scene second = build({turned}, {}, cells_tolerance_m), third = build({far}, {}, cells_tolerance_m);
  CHECK(second.surfaces.size() == 2);
  CHECK(third.surfaces.size() == 2);
  const auto places = [](const Scene& s, const dvec3& shift) {
    std::vector<std::array<double, 3>> out;
    for (const dvec3& v : s.vertices) {
      const dvec3 p = v + s.origin_m - shift;
      out.push_back({std::round(p.x * 1e6), std::round(p.y * 1e6), std::round(p.z * 1e5)});
    }
    std::sort(out.begin(), out.end());
    return out;
  };
  const auto expected = places(first, dvec3(0));
  size_t differ = 0;
  const auto compare = [&](const std::vector<std::array<double, 3>>& other) {
    REQUIRE(other.size() == expected.size());
    for (size_t i = 0; i < other.size(); ++i)
      for (size_t k = 0; k < 3; ++k) differ += std::abs(other[i][k] - expected[i][k]) > 1;
  };
  compare(places(second, dvec3(0)));
  compare(places(third, dvec3(691000.37, 5334000.21, 517.93)));
  CHECK(differ == 0);
}

TEST_CASE("planes that meet at a small angle meet in a line of the mesh") {
  for (const double bend : {0.001, 0.002, 0.004, 0.02, 0.3}) {
    CAPTURE(bend);
    const Height kink = [bend](double x, double y) { return 0.0123 * x + 0.0187 * y + bend * std::max(0.0, x - 24); };
    const Scene s = build({cells({.decimals = 3}, kink)}, {}, cells_tolerance_m);
    CHECK(s.surfaces.size() == 2);
    CHECK(s.report.bent_triangles == 0);
    CHECK(s.report.flattened_by_m <= cells_tolerance_m);
    CHECK(off_plane_m(s) < 1e-8);
    for (const Surface& f : s.surfaces) CHECK(f.triangle_count % (8 * 2 * 12) == 0);  // whole cells: 24 of 60, and 36
  }
}

TEST_CASE("a box of noisy cells is six planes, its corners on three") {
  // Each face of 10 x 10 cells of 1 m; noise in all directions.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 3e-4);
  std::vector<RawMesh> faces;
  std::map<std::array<int, 3>, dvec3> moved;
  const auto place = [&](std::array<int, 3> at) {
    const auto [entry, is_new] = moved.try_emplace(at, dvec3(at[0], at[1], at[2]));
    if (is_new) entry->second += dvec3(noise(random), noise(random), noise(random));
    return entry->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 10}) {
      RawMesh face = mesh({}, {});
      for (int i = 0; i <= 10; ++i) {
        for (int j = 0; j <= 10; ++j) {
          std::array<int, 3> at{};
          at[axis] = side;
          at[(axis + 1) % 3] = i;
          at[(axis + 2) % 3] = j;
          face.vertices.push_back(place(at));
        }
      }
      for (uint32_t i = 0; i < 10; ++i) {
        for (uint32_t j = 0; j < 10; ++j) {
          const uint32_t a = i * 11 + j;
          face.triangles.push_back({a, a + 11, a + 12});
          face.triangles.push_back({a, a + 12, a + 1});
        }
      }
      faces.push_back(face);
    }
  }
  const Scene s = build(faces, {}, cells_tolerance_m);
  CHECK(s.surfaces.size() == 6);
  CHECK(off_plane_m(s) < 1e-12);
  CHECK(s.report.flattened_by_m <= cells_tolerance_m);
  CHECK(std::ranges::count_if(s.wedges, [](const Wedge& w) { return w.exterior_rad > std::numbers::pi; }) == 12);
  CHECK(s.wedges.size() <= 24);  // no angle is quite right: corners inside
}

TEST_CASE("strips of other cells beside each other, not welded along, are one plane; two materials share it") {
  const RawMesh coarse = cells({.along = 30, .across = 2, .length_m = 2, .width_m = 3, .decimals = 3}, road);
  const RawMesh fine =
      cells({.along = 80, .across = 5, .length_m = 0.75, .width_m = 0.9, .decimals = 3, .seed = 2}, road, {0, 6, 0});
  const Scene s = build({coarse, fine}, {0, 1}, cells_tolerance_m);
  REQUIRE(s.surfaces.size() == 2);
  CHECK(s.surfaces[0].normal == s.surfaces[1].normal);
  CHECK(s.surfaces[0].offset_m == s.surfaces[1].offset_m);
}
