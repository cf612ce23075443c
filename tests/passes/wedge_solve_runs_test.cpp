// SPDX-License-Identifier: Apache-2.0
// wedge_solve: candidates that differ by their receivers alone, which CPUs solve eight at once, have the paths that
// each of them has by itself.
#include <doctest/doctest.h>

#include "passes/wedge_questions.hpp"
#include "reference/quads.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("many receivers of one listener have the points that each of them has alone, bit by bit") {
  // A screen that stands on the ground, and a wall behind the receivers. Some receivers see the edge beyond its end, in
  // front of the screen, in its plane, on the ground, or by a point of the wall that is beside it.
  const std::vector<reference::Quad> quads{{{0, -20, 4}, {0, 40, 0}, {0, 0, -4}},
                                           {{-200, -200, 0}, {400, 0, 0}, {0, 400, 0}},
                                           {{30, -12, 0}, {0, 24, 0}, {0, 0, 9}}};
  Scene scene = reference::scene_of_quads(quads);
  scene.wedges = {reference::free_wedges(quads[0], 0)[0]};
  const glm::dvec3 tx{-12, -3, 1.5};
  std::vector<glm::dvec3> receivers;
  for (uint32_t i = 0; i < 53; ++i)
    receivers.push_back({-4.0 + 0.5 * i, -24.0 + 7.3 * (i % 7), i % 11 == 0 ? 0.0 : 1.0 + 0.25 * (i % 5)});
  for (const auto& [before, after] : std::vector<std::pair<std::vector<uint32_t>, std::vector<uint32_t>>>{
           {{}, {}}, {{1}, {}}, {{}, {1}}, {{}, {2}}, {{1}, {2, 1}}, {{1}, {1, 2}}}) {
    std::vector<Question> questions;
    for (uint32_t receiver = 0; receiver < receivers.size(); ++receiver)
      questions.push_back({0, receiver, before, {0}, after});
    const auto together = solve(scene, {tx}, receivers, questions, 6, true);
    size_t alone = 0;
    for (size_t i = 0; i < questions.size(); ++i) {
      CAPTURE(i);
      const auto own = solve(scene, {tx}, receivers, {questions[i]});
      alone += own.size();
      REQUIRE(together.contains(i) == !own.empty());
      if (!own.empty()) CHECK(together.at(i).points == own.at(0).points);
    }
    CHECK(together.size() == alone);
    CHECK(alone > 2);
    CHECK(alone < questions.size());
  }
}
