// SPDX-License-Identifier: Apache-2.0
// Diffracted paths of the brute-force oracle against closed forms: Keller's cone, images, unfolded edges, counts.
// Expected points and lengths are written out here; the oracle itself bisects.
#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include "reference/brute_force.hpp"
#include "reference/quads.hpp"
#include "wavetracer/paths.hpp"

using namespace wavetracer;
using namespace wavetracer::reference;
using glm::dvec3;

namespace {

// A screen in the plane x = 0, y from -50 to 50, z from 0 to 4, and its four edges: bottom, y = 50, top, y = -50.
const Quad long_screen{{0, -50, 0}, {0, 100, 0}, {0, 0, 4}};
const uint32_t top = 2;
const Quad wide_ground{{-200, -200, 0}, {400, 0, 0}, {0, 400, 0}};

Scene with_wedges(const std::vector<Quad>& quads, std::vector<Wedge> wedges) {
  Scene scene = scene_of_quads(quads);
  scene.wedges = std::move(wedges);
  return scene;
}

Scene top_edge_only(std::vector<Quad> others) {
  others.insert(others.begin(), long_screen);
  return with_wedges(others, {free_wedges(long_screen, 0)[top]});
}

// Returns the point where the straight line between both ends meets the edge x = 0, z = height once the edge's planes
// are unfolded.
dvec3 split(const dvec3& a, const dvec3& b, double height) {
  const double from = std::hypot(a.x, a.z - height), to = std::hypot(b.x, b.z - height);
  return {0, (a.y * to + b.y * from) / (from + to), height};
}

size_t count(const PathGeometry& paths, size_t order, uint8_t kind) {
  size_t found = 0;
  for (size_t i = 0; i < paths.size(); ++i)
    found += paths.first[i + 1] - paths.first[i] == order &&
             std::count(paths.interaction.begin() + static_cast<ptrdiff_t>(paths.first[i]),
                        paths.interaction.begin() + static_cast<ptrdiff_t>(paths.first[i + 1]), kind) > 0;
  return found;
}

// Returns how far the path bends away from Keller's cone at its vertex k, as a difference of cosines.
double off_cone(const PathGeometry& paths, size_t i, size_t k, const Wedge& wedge, const dvec3& tx, const dvec3& rx) {
  const dvec3 before = k == paths.first[i] ? tx : paths.vertex[k - 1];
  const dvec3 after = k + 1 == paths.first[i + 1] ? rx : paths.vertex[k + 1];
  return std::abs(glm::dot(wedge.along, glm::normalize(paths.vertex[k] - before)) -
                  glm::dot(wedge.along, glm::normalize(after - paths.vertex[k])));
}

}  // namespace

TEST_CASE("over a screen: the point divides the edge as the straight line of the unfolded planes does") {
  const Scene scene = top_edge_only({});
  for (const dvec3 rx : {dvec3(7, 11, 1), dvec3(0.5, -30, 3.9), dvec3(60, 2, 2)}) {
    const dvec3 tx{-12, -3, 1.5};
    const PathGeometry paths = brute_force_all(scene, {tx}, {rx}, {.max_depth = 1, .diffraction = true});
    REQUIRE(paths.size() == 1);  // the screen hides the line of sight
    CHECK(paths.interaction == std::vector<uint8_t>{diffraction});
    CHECK(paths.surface == std::vector<uint32_t>{0});
    CHECK(glm::distance(paths.vertex[0], split(tx, rx, 4)) < 1e-10);
    const double unfolded = std::hypot(std::hypot(tx.x, tx.z - 4) + std::hypot(rx.x, rx.z - 4), rx.y - tx.y);
    CHECK(path_length_m(paths, 0, tx, rx) == doctest::Approx(unfolded).epsilon(1e-14));
    CHECK(off_cone(paths, 0, 0, scene.wedges[0], tx, rx) < 1e-12);
  }
}

TEST_CASE("a point beyond the edge's ends is no path, one on its end is") {
  const Scene scene = top_edge_only({});
  const Limits limits{.max_depth = 1, .diffraction = true};
  const auto diffracted = [&](double tx_y, double rx_y) {
    return count(brute_force_all(scene, {{-5, tx_y, 2}}, {{5, rx_y, 2}}, limits), 1, diffraction);
  };
  CHECK(diffracted(48, 51) == 1);  // at 49.5
  CHECK(diffracted(50, 50) == 1);
  CHECK(diffracted(49, 51.5) == 0);
}

TEST_CASE("a right-angled corner between ends placed alike: the middle of the edge") {
  // Solid for x < 0 and y < 0. Both ends are 5 m from the edge, mirrored at the plane x = y, and as high.
  const Quad x_wall{{0, -20, 0}, {0, 20, 0}, {0, 0, 10}}, y_wall{{-20, 0, 0}, {20, 0, 0}, {0, 0, 10}};
  Wedge wedge;
  wedge.length_m = 10;
  wedge.face = {0, -1, 0};
  wedge.normal = {1, 0, 0};
  wedge.along = {0, 0, 1};
  wedge.exterior_rad = 1.5 * M_PI;
  wedge.surface = {0, 1};
  const Scene scene = with_wedges({x_wall, y_wall}, {wedge});
  const Limits limits{.max_depth = 1, .diffraction = true};
  const PathGeometry hidden = brute_force_all(scene, {{3, -4, 2}}, {{-4, 3, 6}}, limits);
  REQUIRE(hidden.size() == 1);
  CHECK(glm::distance(hidden.vertex[0], dvec3(0, 0, 4)) < 1e-10);
  // In sight of each other: line of sight, a reflection at (-1, 0) of the wall y = 0, and the corner still diffracts.
  const PathGeometry seen = brute_force_all(scene, {{3, 4, 2}}, {{-4, 3, 6}}, limits);
  CHECK(seen.interaction == std::vector<uint8_t>{reflection, diffraction});
  CHECK(seen.size() == 3);
  // From within the solid nothing is diffracted, whatever the triangles hide.
  CHECK(count(brute_force_all(scene, {{-3, -4, 2}}, {{4, 3, 6}}, limits), 1, diffraction) == 0);
  CHECK(count(brute_force_all(scene, {{4, 3, 6}}, {{-3, -4, 2}}, limits), 1, diffraction) == 0);
}

TEST_CASE("over a screen and off the ground: the mirrored end, before, after, and both") {
  const dvec3 tx{-12, -3, 1.5}, rx{7, 11, 1}, tx_image{-12, -3, -1.5}, rx_image{7, 11, -1};
  const Scene scene = top_edge_only({wide_ground});
  const PathGeometry paths = brute_force_all(scene, {tx}, {rx}, {.max_depth = 3, .diffraction = true});
  struct {
    dvec3 from, to;
    std::vector<uint8_t> kinds;
  } expected[] = {{tx, rx, {diffraction}},
                  {tx_image, rx, {reflection, diffraction}},
                  {tx, rx_image, {diffraction, reflection}},
                  {tx_image, rx_image, {reflection, diffraction, reflection}}};
  REQUIRE(paths.size() == 4);
  for (const auto& [from, to, kinds] : expected) {
    const dvec3 edge = split(from, to, 4);
    const double length = glm::distance(from, edge) + glm::distance(edge, to);
    bool found = false;
    for (size_t i = 0; i < paths.size() && !found; ++i)
      found = std::equal(kinds.begin(), kinds.end(), paths.interaction.begin() + static_cast<ptrdiff_t>(paths.first[i]),
                         paths.interaction.begin() + static_cast<ptrdiff_t>(paths.first[i + 1])) &&
              std::abs(path_length_m(paths, i, tx, rx) - length) < 1e-11;
    CHECK(found);
  }
}

TEST_CASE("around a box: two edges of one face, four ways, and no single edge sees both ends") {
  const dvec3 lower{-2, -3, -4}, upper{2, 3, 4}, tx{-6, 0.5, -0.3}, rx{9, -0.4, 0.8};
  const Scene scene = with_wedges(box_walls(lower, upper), box_wedges(lower, upper));
  CHECK(brute_force_all(scene, {tx}, {rx}, {.max_depth = 3, .diffraction = true}).size() == 0);
  const PathGeometry paths =
      brute_force_all(scene, {tx}, {rx}, {.max_depth = 3, .diffraction = true, .max_diffractions = 2});
  std::vector<double> expected, found;
  for (const double y : {-3.0, 3.0})
    expected.push_back(std::hypot(std::hypot(-2 - tx.x, y - tx.y) + 4 + std::hypot(rx.x - 2, y - rx.y), rx.z - tx.z));
  for (const double z : {-4.0, 4.0})
    expected.push_back(std::hypot(std::hypot(-2 - tx.x, z - tx.z) + 4 + std::hypot(rx.x - 2, z - rx.z), rx.y - tx.y));
  REQUIRE(paths.size() == 4);
  for (size_t i = 0; i < 4; ++i) {
    found.push_back(path_length_m(paths, i, tx, rx));
    for (size_t k = paths.first[i]; k < paths.first[i + 1]; ++k)
      CHECK(off_cone(paths, i, k, scene.wedges[paths.surface[k]], tx, rx) < 1e-11);
  }
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  for (size_t i = 0; i < 4; ++i) CHECK(found[i] == doctest::Approx(expected[i]).epsilon(1e-13));
}

TEST_CASE("two screens whose upper edges are skew: Keller's cone at both") {
  const Quad first{{-3, -50, 0}, {0, 100, 0}, {0, 0, 4}}, second{{3, -50, 0}, {0, 100, 6}, {0, 0, 4}};
  const Scene scene = with_wedges({first, second}, {free_wedges(first, 0)[top], free_wedges(second, 1)[top]});
  const dvec3 tx{-9, -4, 0.2}, rx{12, 5, 2};  // neither edge alone sees both
  const PathGeometry paths =
      brute_force_all(scene, {tx}, {rx}, {.max_depth = 2, .diffraction = true, .max_diffractions = 2});
  REQUIRE(paths.size() == 1);
  CHECK(paths.surface == std::vector<uint32_t>{0, 1});
  for (size_t k = 0; k < 2; ++k) CHECK(off_cone(paths, 0, k, scene.wedges[k], tx, rx) < 1e-11);
}

TEST_CASE("a free screen: every edge diffracts, unless free edges are left out") {
  const Quad small{{0, -1, -1.5}, {0, 2, 0}, {0, 0, 3}};
  const Scene scene = with_wedges({small}, free_wedges(small, 0));
  const dvec3 tx{-3, 0.2, 0.1}, rx{4, -0.3, 0.2};
  CHECK(brute_force_all(scene, {tx}, {rx}, {.max_depth = 1, .diffraction = true}).size() == 4);
  CHECK(brute_force_all(scene, {tx}, {rx}, {.max_depth = 1, .diffraction = true, .free_edges = false}).size() == 0);
  CHECK(brute_force_all(scene, {tx}, {rx}, {.max_depth = 1, .transmission = true, .diffraction = true}).size() == 5);
  CHECK(brute_force_all(scene, {tx}, {rx}, {.max_depth = 0, .transmission = true, .diffraction = true}).size() == 0);
}

TEST_CASE("a leg to the edge is blocked as well, or passes what is in its way") {
  const Quad obstacle{{-6, -5, 2}, {0, 10, 0}, {0, 0, 1.5}};  // between the transmitter and the edge
  const Scene scene = top_edge_only({obstacle});
  const dvec3 tx{-12, 0.3, 1.5}, rx{7, 0.1, 1};
  CHECK(brute_force_all(scene, {tx}, {rx}, {.max_depth = 1, .diffraction = true}).size() == 0);
  const PathGeometry paths = brute_force_all(
      scene, {tx}, {rx}, {.max_depth = 2, .reflection = false, .transmission = true, .diffraction = true});
  REQUIRE(paths.size() == 2);  // straight through the screen below the obstacle; over the edge through the obstacle
  CHECK(paths.interaction == std::vector<uint8_t>{transmission, transmission, diffraction});
  CHECK(paths.surface == std::vector<uint32_t>{0, 1, 0});
  const dvec3 edge = split(tx, rx, 4);
  CHECK(glm::distance(paths.vertex[1], tx + (edge - tx) * 0.5) < 1e-10);
}

TEST_CASE("reciprocity of diffracted and transmitted paths") {
  const dvec3 lower{-2, -3, 0}, upper{2, 3, 4}, a{-6, 2.5, 1.3}, b{3, -5.4, 1.8};
  std::vector<Quad> quads = box_walls(lower, upper);
  quads.push_back({{-30, -8, -1}, {60, 0, 0}, {0, 0, 20}});
  const Scene scene = with_wedges(quads, box_wedges(lower, upper));
  const Limits limits{.max_depth = 3, .transmission = true, .diffraction = true, .max_diffractions = 2};
  const PathGeometry there = brute_force_all(scene, {a}, {b}, limits), back = brute_force_all(scene, {b}, {a}, limits);
  std::vector<double> one, other;
  for (size_t i = 0; i < there.size(); ++i) one.push_back(path_length_m(there, i, a, b));
  for (size_t i = 0; i < back.size(); ++i) other.push_back(path_length_m(back, i, b, a));
  std::sort(one.begin(), one.end());
  std::sort(other.begin(), other.end());
  REQUIRE(one.size() == other.size());
  CHECK(one.size() > 20);
  for (size_t i = 0; i < one.size(); ++i) CHECK(one[i] == doctest::Approx(other[i]).epsilon(1e-12));
}
