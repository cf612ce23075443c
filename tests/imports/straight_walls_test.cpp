// SPDX-License-Identifier: Apache-2.0
// Corners that rounding has put beside a wall are moved onto it; walls that bend by more than rounding stay.
#include "imports/straight_walls.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "imported.hpp"

using namespace wavetracer;
using namespace wavetracer::imports;
using glm::dvec2;

namespace {

constexpr double rounding_m = 5.6e-3;

Footprint outline(RingM ring) {
  Footprint out;
  out.outer = std::move(ring);
  return out;
}

double off_m(const dvec2& p, const dvec2& a, const dvec2& b) {
  const dvec2 along = glm::normalize(b - a), d = p - a;
  return std::abs(along.x * d.y - along.y * d.x);
}

}  // namespace

TEST_CASE("a corner 7 mm beside a wall of 40 m goes onto it, and no other corner moves") {
  const dvec2 a(-20, 0), corner(0, -0.007), b(20, 0);
  const StraightWalls walls = straight_walls(std::vector{outline({a, corner, b, {20, 10}, {-20, 10}, a})}, rounding_m);
  REQUIRE(walls.moved.size() == 1);
  CHECK(off_m(walls.moved.at(corner), a, b) < 1e-12);
  CHECK(walls.farthest_m == doctest::Approx(0.007));
  CHECK(straight_walls(std::vector{outline({a, {0, -0.02}, b, {20, 10}, {-20, 10}})}, rounding_m).moved.empty());
  CHECK(straight_walls(std::vector{outline({a, corner, b, {20, 10}, {-20, 10}})}, 0).moved.empty());
}

TEST_CASE("a row of houses has one wall, whatever their order; corners that they share stay shared") {
  std::vector<Footprint> row;
  std::vector<dvec2> front, back;
  const double turn = 0.4;
  const auto at = [&](double x, double y) {
    return dvec2(x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn));
  };
  for (int i = 0; i <= 6; ++i) {
    front.push_back(at(8.0 * i, 0.006 * std::sin(9.0 * i * i) * (i % 6 != 0)));
    back.push_back(at(8.0 * i, 11));
  }
  for (size_t i = 0; i < 6; ++i) row.push_back(outline({front[i], front[i + 1], back[i + 1], back[i]}));
  const StraightWalls walls = straight_walls(row, rounding_m);
  const auto place = [&](const dvec2& p) { return walls.moved.contains(p) ? walls.moved.at(p) : p; };
  for (const dvec2& p : front) CHECK(off_m(place(p), front[0], front[6]) < 1e-4 + 1e-12);
  CHECK(walls.farthest_m <= 0.006);
  std::reverse(row.begin(), row.end());
  for (Footprint& f : row) std::rotate(f.outer.begin(), f.outer.begin() + 2, f.outer.end());
  const StraightWalls again = straight_walls(row, rounding_m);
  REQUIRE(again.moved.size() == walls.moved.size());
  for (const auto& [from, to] : walls.moved) CHECK(glm::distance(again.moved.at(from), to) < 1e-12);
}

TEST_CASE("round walls stay round") {
  RingM tower;
  for (int i = 0; i < 24; ++i) tower.emplace_back(5 * std::cos(i * 0.2618), 5 * std::sin(i * 0.2618));
  CHECK(straight_walls(std::vector{outline(tower)}, rounding_m).moved.empty());
}

TEST_CASE("the rounding of coordinates is told by their decimals") {
  const auto of = [](RingM ring) { return rounding_of(std::vector{outline(std::move(ring))}, metre_steps); };
  CHECK(of({{1.25, 2}, {691000.5, 3.01}, {4, 5}}) == doctest::Approx(0.005));
  CHECK(of({{1.251, 2}, {691000.5, 3.01}, {4, 5}}) == doctest::Approx(0.0005));
  CHECK(of({{1.2345678, 2}, {3, 3.01}, {4, 5}}) == 0);
}

TEST_CASE("an OpenStreetMap wall with such a corner is one surface, and the summary says what was moved") {
  test::OsmText osm;
  osm.way({{-20, 0}, {0, -0.007}, {20, 0}, {20, 10}, {-20, 10}}, {{"building", "yes"}, {"height", "12"}});
  const test::TemporaryFolder folder;
  const test::Imported imported = test::import_text(osm.text(), folder);
  CHECK(imported.scene.surfaces.size() == 7);  // four walls, roof, floor and the ground
  CHECK(imported.summary.straightened <= 1);   // none where the nodes of OSM are in a line by chance
  CHECK(imported.summary.rounding_m == doctest::Approx(5.6e-3).epsilon(0.01));
  if (imported.summary.straightened > 0)
    CHECK(describe(imported.summary).find("straight   1 corners") != std::string::npos);
}
