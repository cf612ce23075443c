// SPDX-License-Identifier: Apache-2.0
// solve: points of all candidates against the image method on parallelograms, and with occlusion against brute force.
// Positions are generic; tests/simulation tests borders.
#include "passes/solve.hpp"

#include <doctest/doctest.h>

#include "passes/image_method.hpp"
#include "reference/brute_force.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Boxes on a ground: five quads each.
std::vector<Quad> random_town(size_t boxes, uint32_t seed) {
  Random random(seed);
  std::vector<Quad> quads{{{-40, -40, 0}, {80, 0, 0}, {0, 80, 0}}};
  for (size_t i = 0; i < boxes; ++i) {
    const glm::dvec3 lower{random.between(-30, 25), random.between(-30, 25), 0};
    const double turn = random.between(0, 1.5), width = random.between(3, 9), depth = random.between(3, 9);
    const glm::dvec3 u{width * std::cos(turn), width * std::sin(turn), 0},
        v{-depth * std::sin(turn), depth * std::cos(turn), 0};
    const glm::dvec3 up{0, 0, random.between(2, 12)};
    quads.insert(quads.end(),
                 {{lower, u, up}, {lower + u, v, up}, {lower + v, u, up}, {lower, v, up}, {lower + up, u, v}});
  }
  return quads;
}

void check_against_image_method(const std::vector<Quad>& quads, const std::vector<glm::dvec3>& transmitters,
                                const std::vector<glm::dvec3>& receivers, uint32_t max_depth, size_t at_least) {
  const std::vector<Sequence> sequences =
      all_sequences(static_cast<uint32_t>(transmitters.size()), static_cast<uint32_t>(quads.size()), max_depth);
  const Exact exact(reference::scene_of_quads(quads), transmitters, receivers, sequences, max_depth);
  std::set<std::pair<Sequence, uint32_t>> expected;
  for (const Sequence& s : with_prefixes(sequences))
    for (uint32_t r = 0; r < receivers.size(); ++r)
      if (image_method(quads, transmitters[s.transmitter], s.surfaces, receivers[r])) expected.emplace(s, r);
  CHECK(expected.size() >= at_least);
  double worst = 0;
  size_t lines_of_sight = 0;
  for (const SolvedPath& path : exact.solved) {
    const Sequence& s = path.sequence;
    lines_of_sight += s.surfaces.empty();
    if (s.surfaces.empty()) continue;
    const auto points = image_method(quads, transmitters[s.transmitter], s.surfaces, receivers[path.receiver]);
    CHECK(expected.erase({s, path.receiver}) == 1);
    if (!points) continue;
    for (size_t k = 0; k < points->size(); ++k) worst = std::max(worst, glm::distance((*points)[k], path.points[k]));
  }
  CHECK(lines_of_sight == transmitters.size() * receivers.size());
  CHECK(expected.empty());
  CHECK(worst < 1e-9);
}

}  // namespace

TEST_CASE("random planes to order 3: exactly what the image method accepts, to a nanometre") {
  Random random(4);
  const std::vector<Quad> quads = random_quads(7, 10, 15, random);
  std::vector<glm::dvec3> receivers;
  for (int i = 0; i < 9; ++i) receivers.push_back(random.in_cube(12));
  check_against_image_method(quads, {random.in_cube(12), random.in_cube(12)}, receivers, 3, 10);
}

TEST_CASE("a box to order 4: 4 n^2 + 2 paths of order n") {
  const std::vector<Quad> quads = reference::box_walls({0, 0, 0}, {5, 4, 3});
  const Exact exact(reference::scene_of_quads(quads), {{1.1, 0.7, 1.3}}, {{3.7, 3.2, 0.9}}, all_sequences(1, 6, 4), 4);
  size_t by_order[5] = {};
  for (const SolvedPath& path : exact.solved) by_order[path.sequence.surfaces.size()] += !path.blocked;
  CHECK(by_order[0] == 1);
  for (size_t n = 1; n <= 4; ++n) CHECK(by_order[n] == 4 * n * n + 2);
}

TEST_CASE("with occlusion: the sets of brute force, in towns of boxes") {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    const std::vector<Quad> quads = random_town(2, seed);
    const Scene scene = reference::scene_of_quads(quads);
    Random random(seed + 100);
    std::vector<glm::dvec3> transmitters{{-35, 1, 7}}, receivers;
    for (int i = 0; i < 6; ++i)
      receivers.push_back({random.between(-38, 38), random.between(-38, 38), random.between(1, 14)});
    const Exact exact(scene, transmitters, receivers, all_sequences(1, static_cast<uint32_t>(quads.size()), 2), 2);
    const PathGeometry slow = reference::brute_force_paths(scene, transmitters, receivers, 2);
    std::set<std::pair<Sequence, uint32_t>> mine, expected;
    for (const SolvedPath& path : exact.solved)
      if (!path.blocked) mine.emplace(path.sequence, path.receiver);
    for (size_t i = 0; i < slow.size(); ++i)
      expected.insert({Sequence{slow.tx[i],
                                {slow.surface.begin() + static_cast<ptrdiff_t>(slow.first[i]),
                                 slow.surface.begin() + static_cast<ptrdiff_t>(slow.first[i + 1])}},
                       slow.rx[i]});
    CHECK(mine == expected);
    CHECK(mine.size() > 10);
  }
}

// Fields leave the line of sight out, and report it (radio/fields.hpp).
TEST_CASE("a receiver at a transmitter: a line of sight of no length, and the reflection straight back") {
  const Exact exact(reference::scene_of_quads({{{-5, -5, 0}, {10, 0, 0}, {0, 10, 0}}}), {{1, 1, 3}}, {{1, 1, 3}},
                    all_sequences(1, 1, 1), 1);
  REQUIRE(exact.solved.size() == 2);
  CHECK(exact.visible() == 2);
  CHECK(exact.solved[0].points.size() + exact.solved[1].points.size() == 1);
  for (const auto& row : exact.solved)
    for (const glm::dvec3& point : row.points) CHECK(point == glm::dvec3{1, 1, 0});
}

TEST_CASE("nothing is solved through a surface, even where points of two surfaces coincide") {
  // Two walls lie in one plane: mirrored by both, an image is at its original place, and its leg crosses them like air.
  const Quad wall{{0, -5, -5}, {0, 10, 0}, {0, 0, 10}}, same_plane{{0, -4, -3}, {0, 9, 0}, {0, 0, 8}};
  Random random(8);
  std::vector<glm::dvec3> receivers;
  for (int i = 0; i < 60; ++i)
    receivers.push_back({random.between(0.5, 4), random.between(-2, 2), random.between(-2, 2)});
  for (const double tilt : {0.0, 0.3, 0.7}) {  // askew, so that points round to either side of the plane
    CAPTURE(tilt);
    const auto turned = [&](const glm::dvec3& p) {
      return glm::dvec3{p.x * std::cos(tilt) - p.y * std::sin(tilt), p.x * std::sin(tilt) + p.y * std::cos(tilt), p.z};
    };
    std::vector<Quad> quads{wall, same_plane};
    for (Quad& q : quads) q = {turned(q.corner), turned(q.u), turned(q.v)};
    std::vector<glm::dvec3> behind = receivers;
    for (glm::dvec3& p : behind) p = turned(p);
    const Exact exact(reference::scene_of_quads(quads), {turned({-3, 0.4, 0.3})}, behind, all_sequences(1, 2, 4), 4);
    CHECK(exact.solved.size() == behind.size());  // the lines of sight, which occlusion then refuses
    CHECK(exact.visible() == 0);
  }
}

TEST_CASE("an edge of two walls: both orders reflect there, and nothing reaches behind them") {
  const std::vector<Quad> walls{{{0, 0, -5}, {0, 10, 0}, {0, 0, 10}},
                                {{0, 0, -5}, {10, 0, 0}, {0, 0, 10}}};  // x = 0, y = 0
  const auto orders = [&](const glm::dvec3& tx, const glm::dvec3& rx) {
    const Exact exact(reference::scene_of_quads(walls), {tx}, {rx}, all_sequences(1, 2, 3), 3);
    std::vector<size_t> depths;
    for (const SolvedPath& path : exact.solved)
      if (!path.blocked) depths.push_back(path.sequence.surfaces.size());
    std::sort(depths.begin(), depths.end());
    return depths;
  };
  CHECK(orders({1, 2, 0.5}, {1, 2, -0.5}) == std::vector<size_t>{0, 1, 1, 2, 2});  // straight back from the edge
  CHECK(orders({1, 2, 0.5}, {1, 2.5, -0.5}) == std::vector<size_t>{0, 1, 1, 2});   // beside it, one order only
  // The ends are on one wall's border and behind the other wall, which begins there: no ray beside the edge gets there.
  CHECK(orders({1, 1, 0.5}, {-1, 1, 0.5}).empty());
}

namespace {

// The lengths of the chains of all paths of an antenna's echoes of itself, whatever the order of the surfaces. Its line
// of sight to itself is left out later (host/radio/fields.hpp).
std::vector<size_t> echoes(const std::vector<Quad>& quads, const glm::dvec3& at, uint32_t max_depth) {
  const auto count = static_cast<uint32_t>(quads.size());
  const Exact exact(reference::scene_of_quads(quads), {at}, {at}, all_sequences(1, count, max_depth), max_depth);
  std::vector<size_t> depths;
  for (const SolvedPath& path : exact.solved)
    if (!path.blocked && !path.sequence.surfaces.empty()) depths.push_back(path.sequence.surfaces.size());
  std::sort(depths.begin(), depths.end());
  return depths;
}

}  // namespace

TEST_CASE("a corner that opens towards the antenna reflects, in every order; the corner of a house does not") {
  const Quad ground{{-20, -20, 0}, {40, 0, 0}, {0, 40, 0}};
  // Two walls that meet at (2, 3): both seen from (1, 1), from either side, and with their other ends nearer to it.
  const double x = 2, y = 3;
  const Quad along_x{{x, y, 0}, {6, 0, 0}, {0, 0, 5}}, along_y{{x, y, 0}, {0, 6, 0}, {0, 0, 5}};
  const Quad back_x{{x, y, 0}, {-6, 0, 0}, {0, 0, 5}}, back_y{{x, y, 0}, {0, -6, 0}, {0, 0, 5}};
  const glm::dvec3 antenna{1, 1, 1.5};
  // The ground; neither wall has a point across from the antenna.
  CHECK(echoes({ground, along_x, along_y}, antenna, 3) == std::vector<size_t>{1});
  // A room: all three, each pair twice, the corner in six orders.
  CHECK(echoes({ground, back_x, back_y}, antenna, 3) ==
        std::vector<size_t>{1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3, 3, 3, 3});
  // One wall goes on past the corner: the ground and that wall, and both.
  const Quad long_x{{x - 6, y, 0}, {12, 0, 0}, {0, 0, 5}};
  CHECK(echoes({ground, long_x, along_y}, antenna, 2) == std::vector<size_t>{1, 1, 2, 2});
  // The wall that begins behind the long one is not in front of it; seen from there the corner is one.
  CHECK(echoes({ground, long_x, along_y}, {1, 4, 1.5}, 2) == std::vector<size_t>{1, 1, 1, 2, 2, 2, 2, 2, 2});
}

TEST_CASE("near the corner of a house, and beside it by what float32 rounds: no path by both of its walls") {
  const Quad ground{{-20, -20, 0}, {40, 0, 0}, {0, 40, 0}};
  for (const double slip : {0.0, 1e-9, 1e-7, 1e-6, -1e-7, 1e-5}) {
    CAPTURE(slip);
    const Quad wall{{2 - slip, 3, 0}, {6, 0, 0}, {0, 0, 5}}, next{{2, 3 - slip, 0}, {slip, 6, 0}, {0, 0, 5}};
    CHECK(echoes({ground, wall, next}, {1, 1, 1.5}, 3) == std::vector<size_t>{1});
  }
}

namespace {

// Solves all receivers together, and each alone: the points must be the same to the last bit. Returns their number.
size_t check_alone(const std::vector<Quad>& quads, const glm::dvec3& transmitter,
                   const std::vector<glm::dvec3>& receivers, uint32_t max_depth) {
  const auto sequences = all_sequences(1, static_cast<uint32_t>(quads.size()), max_depth);
  const Scene scene = reference::scene_of_quads(quads);
  const Exact together(scene, {transmitter}, receivers, sequences, max_depth);
  std::vector<SolvedPath> alone;
  for (uint32_t i = 0; i < receivers.size(); ++i)
    for (SolvedPath path : Exact(scene, {transmitter}, {receivers[i]}, sequences, max_depth).solved) {
      path.receiver = i;
      alone.push_back(path);
    }
  std::sort(alone.begin(), alone.end(), [](const SolvedPath& a, const SolvedPath& b) {
    return std::tie(a.sequence, a.receiver) < std::tie(b.sequence, b.receiver);
  });
  REQUIRE(together.solved.size() == alone.size());
  size_t wrong = 0;
  for (size_t i = 0; i < alone.size(); ++i) {
    const SolvedPath &a = together.solved[i], &b = alone[i];
    wrong += a.sequence != b.sequence || a.receiver != b.receiver || a.points != b.points || a.blocked != b.blocked;
  }
  CHECK(wrong == 0);
  return alone.size();
}

}  // namespace

TEST_CASE("receivers that are solved together have the points that each has alone, also in corners") {
  std::vector<glm::dvec3> receivers;
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 5; ++y) receivers.push_back({-30 + 8 * x, -30 + 13 * y, 2});
  CHECK(check_alone(random_town(3, 5), {-33, -31, 4}, receivers, 2) > 2 * receivers.size());
  // Beside the antenna itself the foot of a wall and the corner of a room reflect in one point, or nearly so.
  const Quad ground{{-20, -20, 0}, {40, 0, 0}, {0, 40, 0}};
  const Quad back_x{{2, 3, 0}, {-6, 0, 0}, {0, 0, 5}}, along_y{{2, 3, 0}, {0, 6, 0}, {0, 0, 5}};
  const glm::dvec3 antenna{1, 1, 1.5};
  std::vector<glm::dvec3> beside;
  for (const double off : {0.0, 1e-10, 1e-9, 1e-8, 1e-6, 1e-4, 1e-3, 0.1})
    for (const glm::dvec3& way : {glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 1}}) beside.push_back(antenna + off * way);
  const Quad back_y{{2, 3, 0}, {0, -6, 0}, {0, 0, 5}};
  CHECK(check_alone({ground, back_x, back_y}, antenna, beside, 3) > 3 * beside.size());
  CHECK(check_alone({ground, back_x, along_y}, antenna, beside, 3) > beside.size());
}
