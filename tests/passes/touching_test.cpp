// SPDX-License-Identifier: Apache-2.0
// Legs near touching surfaces: walls that stand on a mirror, houses side by side, edges that are only touched. They run
// in any direction and far from the origin, with occlusion and with transmissions.
#include <doctest/doctest.h>

#include <numbers>

#include "passes/image_method.hpp"
#include "passes/occlusion.hpp"
#include "passes/solved_rows.hpp"
#include "passes/transmissions.hpp"
#include "passes/wedges.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Turned about the vertical and moved.
struct PlacedAt {
  double turn = 0;
  glm::dvec3 at{0};

  glm::dvec3 vector(const glm::dvec3& v) const {
    return {v.x * std::cos(turn) - v.y * std::sin(turn), v.x * std::sin(turn) + v.y * std::cos(turn), v.z};
  }
  glm::dvec3 operator()(const glm::dvec3& p) const { return vector(p) + at; }
  std::vector<Quad> operator()(std::vector<Quad> quads) const {
    for (Quad& q : quads) q = {(*this)(q.corner), vector(q.u), vector(q.v)};
    return quads;
  }
};

const std::vector<PlacedAt> touching_places{{0, {0, 0, 0}},         {0.3, {0, 0, 0}},     {1.1, {7.3, -2.9, 0}},
                                            {2.5, {500, -400, 30}}, {0.7, {0, 450, -20}}, {5.3, {-610, 10, 0}}};

std::vector<Quad> operator+(std::vector<Quad> a, const std::vector<Quad>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct TouchingWorld {
  Scene scene;
  DeviceScene uploaded;
  std::optional<Wedges> wedges;

  explicit TouchingWorld(const std::vector<Quad>& quads, std::vector<Wedge> edges = {})
      : scene(reference::scene_of_quads(quads)), uploaded(make_device_scene(context(), scene, false, 2000)) {
    scene.wedges = std::move(edges);
    if (!scene.wedges.empty()) wedges.emplace(context(), scene, std::vector<Scene>{}, std::vector<Instance>{}, true);
  }

  // Returns the surfaces that the path passes by occlusion (all or nothing) and by transmissions, which must agree.
  bool free(const PathRow& row) {
    const StepTables steps{wedges ? &wedges->list().wedges : nullptr, nullptr};
    Counters counters(context());
    SolvedList list = upload_rows({row}, 8), passed = upload_rows({row}, 8);
    Occlusion(context(), uploaded)(uploaded, ends_of({row}), list, counters, nullptr, steps);
    Transmissions(context(), uploaded, 8)(uploaded, ends_of({row}), passed, counters, steps);
    const bool blocked = download_rows(list)[0].blocked;
    const PathRow through = download_rows(passed)[0];
    CHECK(blocked == (through.blocked || through.steps.size() > row.steps.size()));
    return !blocked;
  }
};

}  // namespace

TEST_CASE("a reflection at the foot of a wall does not go on behind the wall, wherever by the foot it falls") {
  const std::vector<Quad> ground{{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}};
  const std::vector<Quad> house = reference::box_walls({10, -8, 0}, {20, 9, 7});
  for (const PlacedAt& placed : touching_places) {
    TouchingWorld closed(placed(ground + house)), open(placed(ground));
    for (const double off : {-9e-5, -3e-5, -1e-5, -1e-6, -1e-7, -1e-9, 0.0, 1e-9, 1e-7, 1e-6, 1e-5, 3e-5, 9e-5, 2e-4})
      for (const double y : {0.0, 0.37, -4.0}) {
        CAPTURE(placed.turn);
        CAPTURE(off);
        const glm::dvec3 from{0, 0, 6}, to{15 + 1.5 * off, 1.5 * y, 3}, foot{10 + off, y, 0};
        const PathRow row{placed(from), placed(to), {0}, {placed(foot)}};
        CHECK(open.free(row));
        CHECK_FALSE(closed.free(row));
        const PathRow back{row.to, row.from, {0}, row.points};
        CHECK_FALSE(closed.free(back));
      }
  }
}

TEST_CASE("edges end at walls, too: what is diffracted beside one does not go on behind it") {
  // The edge of a low roof runs into a high wall, inside of it and at its foot.
  for (const double foot : {0.0, 3.0})
    for (const PlacedAt& placed : touching_places) {
      const Quad high{{5, -10, foot}, {0, 20, 0}, {0, 0, 12}};
      const std::vector<Quad> low = reference::box_walls({0, 0, 0}, {5, 6, 3});
      std::vector<Wedge> edges = reference::box_wedges({0, 0, 0}, {5, 6, 3});
      for (Wedge& w : edges)
        w.start = placed(w.start), w.along = placed.vector(w.along), w.face = placed.vector(w.face),
        w.normal = placed.vector(w.normal);
      TouchingWorld world(placed(low + std::vector{high}), edges);
      const auto edge = std::ranges::find_if(world.scene.wedges, [&](const Wedge& w) {
        const auto on = [&](const glm::dvec3& p) {
          return glm::length(glm::cross(placed(p) - w.start, w.along)) < 1e-6;
        };
        return on({0, 0, 3}) && on({5, 0, 3});
      });
      REQUIRE(edge != world.scene.wedges.end());
      const uint32_t step = WT_STEP_DIFFRACTION | static_cast<uint32_t>(edge - world.scene.wedges.begin());
      for (const double off : {-5e-5, -1e-6, 0.0}) {
        CAPTURE(off);
        const PathRow row{placed({0, -5, 1}), placed({9, 3, 6}), {step}, {placed({5 + off, 0, 3})}};
        CHECK_FALSE(world.free(row));
        CHECK(world.free({row.from, placed({1, 4, 5}), {step}, row.points}));
      }
    }
}

TEST_CASE("along the roofs and the front of houses side by side the walls between them hide nothing") {
  for (const PlacedAt& placed : touching_places) {
    CAPTURE(placed.turn);
    std::vector<Quad> row;
    for (int i = 0; i < 4; ++i) row = row + reference::box_walls({5.0 * i, 0, 0}, {5.0 * i + 5, 6, 8});
    const std::vector<Quad> chimney = reference::box_walls({11, 2, 8}, {12, 3, 8.01});
    TouchingWorld houses(placed(row)), blocked(placed(row + chimney));
    const auto leg = [&](const glm::dvec3& a, const glm::dvec3& b) { return PathRow{placed(a), placed(b), {}, {}}; };
    for (const double off : {0.0, 3e-5}) {
      CHECK(houses.free(leg({1, 2, 8 + off}, {19, 3, 8 + off})));
      CHECK_FALSE(blocked.free(leg({1, 2, 8 + off}, {19, 3, 8 + off})));
      CHECK(houses.free(leg({1, -off, 2}, {19, -off, 7})));
      CHECK(houses.free(leg({-4, -off, 2}, {30, -off, 3})));
    }
    CHECK_FALSE(houses.free(leg({1, 2, 7.99}, {19, 3, 7.99})));
    CHECK_FALSE(houses.free(leg({-1, 0.01, 2}, {21, 0.01, 7})));
  }
}

TEST_CASE("the same from edge to edge over a roof that houses share") {
  for (const PlacedAt& placed : touching_places) {
    std::vector<Quad> houses = reference::box_walls({-10, -5, 0}, {10, 0, 8});
    houses = houses + reference::box_walls({-10, 0, 0}, {10, 5, 8});
    std::vector<Wedge> edges = reference::box_wedges({-10, -5, 0}, {10, 0, 8});
    const std::vector<Wedge> further = reference::box_wedges({-10, 0, 0}, {10, 5, 8}, 6);
    edges.insert(edges.end(), further.begin(), further.end());
    for (Wedge& w : edges)
      w.start = placed(w.start), w.along = placed.vector(w.along), w.face = placed.vector(w.face),
      w.normal = placed.vector(w.normal);
    TouchingWorld world(placed(houses), edges);
    const auto on = [&](const glm::dvec3& p) {
      const auto found = std::ranges::find_if(world.scene.wedges, [&](const Wedge& w) {
        const glm::dvec3 d = placed(p) - w.start;
        return glm::length(glm::cross(d, w.along)) < 1e-6 && glm::dot(d, w.along) > 0 &&
               glm::dot(d, w.along) < w.length_m;
      });
      return WT_STEP_DIFFRACTION | static_cast<uint32_t>(found - world.scene.wedges.begin());
    };
    for (const double x : {0.0, 1.37, -9.99}) {
      const glm::dvec3 first{x, -5, 8}, last{0.5 * x + 1, 5, 8};
      const PathRow row{
          placed({x, -25, 1.5}), placed({x, 22, 1.5}), {on(first), on(last)}, {placed(first), placed(last)}};
      CHECK(world.free(row));
      CHECK(world.free({row.to, row.from, {row.steps[1], row.steps[0]}, {row.points[1], row.points[0]}}));
      // Under the roof, in the air: the same legs, but from points that are on nothing.
      CHECK_FALSE(world.free({placed({x, -5, 7.9}), placed({x, 5, 7.9}), {}, {}}));
    }
  }
}

TEST_CASE("what only touches the edge of a house is not hidden by it, and what goes through two edges is") {
  for (const PlacedAt& placed : touching_places)
    for (const double slope : {0.2, 1.0 / 3, 1.0, 2.7}) {
      CAPTURE(slope);
      // The corner of one house at 10, 10 slope is touched; that of the other one leads in.
      const double y = 10 * slope;
      TouchingWorld beside(placed(reference::box_walls({3, y, 0}, {10, y + 8, 9})));
      TouchingWorld through(placed(reference::box_walls({10, y, 0}, {20, y + 10 * slope, 9})));
      for (const double rise : {0.0, 0.11}) {
        const PathRow row{placed({0, 0, 2}), placed({40, 40 * slope, 2 + 40 * rise}), {}, {}};
        CHECK(beside.free(row));
        CHECK_FALSE(through.free(row));
      }
    }
}
