// SPDX-License-Identifier: Apache-2.0
// wedge_solve: points on one edge and on two against closed forms and the reference's bisection, whose lengths are
// minimal; edges' ends, reflections, and cases without a path.
#include "passes/wedge_solve.hpp"

#include <doctest/doctest.h>

#include "passes/image_method.hpp"
#include "passes/wedge_questions.hpp"
#include "reference/wedge_points.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

double length_over(const glm::dvec3& a, const std::vector<glm::dvec3>& points, const glm::dvec3& b) {
  double length = glm::distance(points.back(), b);
  glm::dvec3 from = a;
  for (const glm::dvec3& p : points) {
    length += glm::distance(from, p);
    from = p;
  }
  return length;
}

// One edge of a panel that stands alone, with a direction and a length.
Quad panel(const glm::dvec3& start, const glm::dvec3& edge, const glm::dvec3& down) { return {start, edge, down}; }

Scene edges_of(const std::vector<Quad>& quads) {
  Scene scene = reference::scene_of_quads(quads);
  for (uint32_t i = 0; i < quads.size(); ++i) scene.wedges.push_back(reference::free_wedges(quads[i], i)[0]);
  return scene;
}

bool one(const Scene& scene, const glm::dvec3& a, const glm::dvec3& b, std::vector<uint32_t> wedges,
         std::vector<uint32_t> before = {}, std::vector<uint32_t> after = {}) {
  return !solve(scene, {a}, {b}, {{0, 0, std::move(before), std::move(wedges), std::move(after)}}).empty();
}

}  // namespace

TEST_CASE("one edge: what bisection finds, and where Keller's cone unfolds") {
  const Scene scene = box_and_panels();
  Random random(9);
  std::vector<glm::dvec3> tx, rx;
  for (int i = 0; i < 8; ++i) tx.push_back(random.in_cube(9)), rx.push_back(random.in_cube(9));
  std::vector<Question> questions;
  for (uint32_t t = 0; t < tx.size(); ++t)
    for (uint32_t r = 0; r < rx.size(); ++r)
      for (uint32_t w = 0; w < scene.wedges.size(); ++w) questions.push_back({t, r, {}, {w}, {}});
  const auto found = solve(scene, tx, rx, questions);
  size_t expected = 0;
  for (size_t i = 0; i < questions.size(); ++i) {
    const glm::dvec3 &a = tx[questions[i].transmitter], &b = rx[questions[i].receiver];
    const Wedge& w = scene.wedges[questions[i].wedges[0]];
    const auto p = reference::diffraction_point(w, a, b);
    const bool path = p && in_sector(w, a) && in_sector(w, b);
    expected += path;
    REQUIRE(found.contains(i) == path);
    if (!path) continue;
    const double xa = glm::dot(a - w.start, w.along), xb = glm::dot(b - w.start, w.along);
    const double ra = glm::length(glm::cross(a - w.start, w.along)), rb = glm::length(glm::cross(b - w.start, w.along));
    const glm::dvec3 closed = w.start + (xa + (xb - xa) * ra / (ra + rb)) * w.along, &point = found.at(i).points[0];
    CHECK(glm::distance(point, closed) < 1e-12);
    CHECK(glm::distance(point, *p) < 1e-6);
  }
  CHECK(expected > 100);
}

TEST_CASE("two edges of a box and of panels, shared faces included: what bisection finds") {
  const Scene scene = box_and_panels();
  const std::vector<glm::dvec3> tx{{-7.1, 1.3, 2.2}, {0.3, 0.9, 9.1}, {2.7, 4.4, 6.6}},
      rx{{6.8, -4.4, 3.3}, {-1.1, 7.3, 6.2}, {3.7, 3.9, 5.1}};
  std::vector<Question> questions;
  for (uint32_t t = 0; t < tx.size(); ++t)
    for (uint32_t v = 0; v < scene.wedges.size(); ++v)
      for (uint32_t w = 0; w < scene.wedges.size(); ++w)
        if (v != w) questions.push_back({t, t, {}, {v, w}, {}});
  const auto found = solve(scene, tx, rx, questions);
  size_t on_faces = 0, across = 0;
  for (size_t i = 0; i < questions.size(); ++i) {
    CAPTURE(i);
    const glm::dvec3 &a = tx[questions[i].transmitter], &b = rx[questions[i].receiver];
    const Wedge &v = scene.wedges[questions[i].wedges[0]], &w = scene.wedges[questions[i].wedges[1]];
    const auto points = reference::diffraction_points(v, w, a, b);
    const bool apart = points && glm::distance((*points)[0], (*points)[1]) > 1e-4;
    const bool path = apart && in_sector(v, a) && in_sector(w, b) &&
                      (share_plane(v, w) || (in_sector(v, (*points)[1]) && in_sector(w, (*points)[0])));
    REQUIRE(found.contains(i) == path);
    if (!path) continue;
    (share_plane(v, w) ? on_faces : across) += 1;
    const std::vector<glm::dvec3>& mine = found.at(i).points;
    CHECK(length_over(a, mine, b) <= length_over(a, {points->begin(), points->end()}, b) + 1e-12);
    for (size_t k = 0; k < 2; ++k) CHECK(glm::distance(mine[k], (*points)[k]) < 1e-6);
  }
  CHECK(on_faces > 20);
  CHECK(across > 20);
}

TEST_CASE("skew, nearly parallel and nearly touching edges: equal angles on both sides of each, and no shorter way") {
  const glm::dvec3 a{-9, 3.1, 0.7}, b{11, 8.2, 1.9};
  for (const double turn : {1.2, 0.3, 1e-2, 1e-4, 1e-7, 0.0})
    for (const double gap : {6.0, 0.3, 1e-2, 1e-3}) {
      CAPTURE(turn);
      CAPTURE(gap);
      const glm::dvec3 first{0, 12, 0}, second{12 * std::sin(turn) * 0.3, 12 * std::cos(turn), 12 * std::sin(turn)};
      const Scene scene =
          edges_of({panel({0, 0, 5}, first, {0, 0, -5}), panel({gap, 0.2, 5 - turn * 4}, second, {0, 0, -5})});
      const auto found = solve(scene, {a}, {b}, {{0, 0, {}, {0, 1}, {}}});
      const Wedge &v = scene.wedges[0], &w = scene.wedges[1];
      const auto expected = reference::diffraction_points(v, w, a, b);
      REQUIRE(expected);
      REQUIRE(found.size() == 1);
      const std::vector<glm::dvec3>& p = found.at(0).points;
      const double length = length_over(a, p, b);
      CHECK(length <= length_over(a, {expected->begin(), expected->end()}, b) * (1 + 1e-14));
      const auto cosine = [](const Wedge& edge, const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(edge.along, glm::normalize(to - from));
      };
      CHECK(std::abs(cosine(v, a, p[0]) - cosine(v, p[0], p[1])) < 1e-10);
      CHECK(std::abs(cosine(w, p[0], p[1]) - cosine(w, p[1], b)) < 1e-10);
      for (const double step : {-1e-4, 1e-4})
        for (const glm::dvec2 by : {glm::dvec2{1, 0}, {0, 1}, {1, 1}, {1, -1}})
          CHECK(length_over(a, {p[0] + step * by.x * v.along, p[1] + step * by.y * w.along}, b) > length);
    }
}

TEST_CASE("the ends of an edge belong to it, and nothing beyond") {
  const Scene scene = edges_of({panel({0, 0, 4}, {0, 10, 0}, {0, 0, -4})});
  for (const double end : {0.0, 10.0}) {
    CHECK(one(scene, {-3, end, 2}, {5, end, 1}, {0}));
    CHECK(one(scene, {-3, end - 4, 4}, {3, end + 4, 4}, {0}));
    const double out = end == 0 ? -1 : 1;
    CHECK_FALSE(one(scene, {-3, end + out * 1e-6, 2}, {5, end + out * 1e-6, 1}, {0}));
    CHECK(one(scene, {-3, end - out * 1e-6, 2}, {5, end - out * 1e-6, 1}, {0}));
  }
}

TEST_CASE("reflections before and after: the edge is met where the images' straight way meets it") {
  const std::vector<Quad> quads{panel({0, -50, 4}, {0, 100, 0}, {0, 0, -4}),
                                {{-200, -200, 0}, {400, 0, 0}, {0, 400, 0}}};
  Scene scene = reference::scene_of_quads(quads);
  scene.wedges = {reference::free_wedges(quads[0], 0)[0]};
  const glm::dvec3 tx{-12, -3, 1.5}, rx{7, 11, 1};
  const std::vector<Question> questions{
      {0, 0, {}, {0}, {}}, {0, 0, {1}, {0}, {}}, {0, 0, {}, {0}, {1}}, {0, 0, {1}, {0}, {1}}};
  const auto found = solve(scene, {tx}, {rx}, questions);
  REQUIRE(found.size() == 4);
  for (const auto& [i, row] : found) {
    const glm::dvec3 a{tx.x, tx.y, questions[i].before.empty() ? tx.z : -tx.z};
    const glm::dvec3 b{rx.x, rx.y, questions[i].after.empty() ? rx.z : -rx.z};
    const double from = std::hypot(a.x, a.z - 4), to = std::hypot(b.x, b.z - 4);
    const glm::dvec3 edge{0, (a.y * to + b.y * from) / (from + to), 4};
    const size_t at = questions[i].before.size();
    CHECK(glm::distance(row.points[at], edge) < 1e-12);
    if (at) CHECK(glm::distance(row.points[0], a + (edge - a) * (a.z / (a.z - 4))) < 1e-12);
    if (b.z < 0) CHECK(glm::distance(row.points.back(), b + (edge - b) * (b.z / (b.z - 4))) < 1e-12);
  }
  // A row has room for this number of interactions and no more.
  CHECK(solve(scene, {tx}, {rx}, questions, 3).size() == 4);
}

TEST_CASE("what is no path: ends on the edge's line or in the solid, reflections at the wedge's own faces, corners") {
  const Scene scene = box_and_panels();
  const glm::dvec3 upper{1.7, 2.4, 4.1};  // upper corner of the box
  // Wedge 3 is the edge along z between the walls x upper (1) and y upper (3).
  const Wedge& w = scene.wedges[3];
  REQUIRE(w.surface == std::array<uint32_t, 2>{1, 3});
  const glm::dvec3 free{5, 1, 2}, also{-1, 6, 3};
  CHECK(one(scene, free, also, {3}));
  CHECK_FALSE(one(scene, w.start + 0.7 * w.along, also, {3}));
  CHECK_FALSE(one(scene, w.start - 2.0 * w.along, also, {3}));
  CHECK_FALSE(one(scene, free, w.start - 2.0 * w.along, {3}));
  CHECK_FALSE(one(scene, {0, 0, 2}, also, {3}));
  CHECK_FALSE(one(scene, free, {0, 0, 2}, {3}));
  // The ends lie on either face, or a nanometre beyond rounding.
  for (const double off : {0.0, 1e-10, 1e-3}) {
    CHECK(one(scene, {upper.x + off, 0.3, 2}, also, {3}));
    CHECK(one(scene, free, {-0.4, upper.y + off, 3}, {3}));
  }
  CHECK_FALSE(one(scene, {upper.x - 1e-3, 0.3, 2}, also, {3}));
  CHECK(one(scene, free, {-1, 6, 5}, {3}, {8}));  // off the ground
  for (const uint32_t face : {1u, 3u}) {
    CHECK_FALSE(one(scene, free, also, {3}, {face}));
    CHECK_FALSE(one(scene, free, also, {3}, {}, {face}));
    CHECK_FALSE(one(scene, free, {-1, 6, 5}, {3}, {8, face}));
  }
  // Two edges that meet at the corner (1.7, 2.4, 4.1), from ends on the diagonal beyond it.
  std::vector<uint32_t> meeting;
  for (uint32_t k = 0; k < 12; ++k) {
    const Wedge& edge = scene.wedges[k];
    const glm::dvec3 end = edge.start + edge.length_m * edge.along;
    if (std::min(glm::distance(edge.start, upper), glm::distance(end, upper)) < 1e-9) meeting.push_back(k);
  }
  REQUIRE(meeting.size() == 3);
  for (const uint32_t v : meeting)
    for (const uint32_t u : meeting)
      if (u != v) CHECK_FALSE(one(scene, upper + glm::dvec3{1, 2, 2.5}, upper + glm::dvec3{2, 1.5, 1}, {v, u}));
}

TEST_CASE("edges of vehicles, where they stand; to its antenna a vehicle is no wedge") {
  Scene still = reference::scene_of_quads({{{-30, -30, 0}, {60, 0, 0}, {0, 60, 0}}});
  std::vector<Scene> models{reference::scene_of_quads({panel({0, -1, 1}, {0, 2, 0}, {0, 0, -1})})};
  models[0].wedges = {reference::free_wedges(panel({0, -1, 1}, {0, 2, 0}, {0, 0, -1}), 0)[0]};
  const std::vector<Instance> instances{{"v", "car", 0, 1, 0}};
  Placement placement;
  placement.position_m = {3, 4, 0};
  placement.rotation = glm::mat3_cast(glm::angleAxis(0.4, glm::dvec3{0, 0, 1}));
  auto [scene, place] =
      with_instances(context(), make_device_scene(context(), still, false, 60), still, models, instances);
  place(scene, std::vector{placement});
  Wedges wedges(context(), still, models, instances, true);
  wedges(scene);
  const Wedge moved = wedge_of(wedges.list().wedges.read_one(0, Stage::transfer));
  const glm::dvec3 a{-2, 3, 0.6}, b{9, 5.5, 1.4};
  const auto expected = reference::diffraction_point(moved, a, b);
  REQUIRE(expected);
  for (const bool own_tx : {false, true})
    for (const bool own_rx : {false, true}) {
      EndState tx{.position_m = a}, rx{.position_m = b};
      if (own_tx) tx.instance = 0;
      if (own_rx) rx.instance = 0;
      const RadioEnds ends = make_radio_ends(context(), {tx}, {rx}, {}, single_listeners({0}));
      Sequences set(context(), 64);
      set.clear();
      WedgeSolve pass(context(), 3, every_wave_m);
      const auto candidates = context().buffer(
          std::vector<wt_wedge_candidate>{{WT_ROOT, WT_ROOT | 1, {0, WT_NONE}, 0, WT_ALL_QUARTERS}}, "candidates");
      set.counters().restart(&wt_counters::wedge_candidates, 1, Stage::wedge_solve);
      const SolvedList& list = pass(scene, wedges.list(), ends, set.table(), candidates, 1, set.counters());
      CHECK(list.count == (own_tx || own_rx ? 0 : 1));
      if (list.count) CHECK(glm::distance(download_rows(list)[0].points[0], *expected) < 1e-6);
    }
}
