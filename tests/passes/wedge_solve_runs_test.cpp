// SPDX-License-Identifier: Apache-2.0
// wedge_solve: candidates that differ by their receivers alone, which CPUs solve eight at once, have the paths that
// each of them has by itself.
#include <doctest/doctest.h>

#include <cmath>

#include "passes/wedge_questions.hpp"
#include "reference/quads.hpp"
#include "wavetracer/device/beams.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A screen that stands on the ground, and a wall behind the receivers. Some receivers see the edge beyond its end, in
// front of the screen, in its plane, on the ground, or by a point of the wall that is beside it.
struct Street {
  std::vector<reference::Quad> quads{{{0, -20, 4}, {0, 40, 0}, {0, 0, -4}},
                                     {{-200, -200, 0}, {400, 0, 0}, {0, 400, 0}},
                                     {{30, -12, 0}, {0, 24, 0}, {0, 0, 9}}};
  Scene scene = reference::scene_of_quads(quads);
  glm::dvec3 tx{-12, -3, 1.5};
  std::vector<glm::dvec3> receivers;

  Street() {
    scene.wedges = {reference::free_wedges(quads[0], 0)[0]};
    for (uint32_t i = 0; i < 53; ++i)
      receivers.push_back({-4.0 + 0.5 * i, -24.0 + 7.3 * (i % 7), i % 11 == 0 ? 0.0 : 1.0 + 0.25 * (i % 5)});
  }

  // Paths to all receivers by these mirrors before and after the edge.
  std::vector<Question> to_all(const std::vector<uint32_t>& before, const std::vector<uint32_t>& after) const {
    std::vector<Question> out;
    for (uint32_t receiver = 0; receiver < receivers.size(); ++receiver)
      out.push_back({0, receiver, before, {0}, after});
    return out;
  }
};

const std::vector<std::pair<std::vector<uint32_t>, std::vector<uint32_t>>> mirrors_around{
    {{}, {}}, {{1}, {}}, {{}, {1}}, {{}, {2}}, {{1}, {2, 1}}, {{1}, {1, 2}}};

// The floors of the links of one transmitter, and what is left out of them.
struct Limits {
  gpu::Buffer<float> floors;
  gpu::Buffer<uint32_t> left_out;
  gpu::Buffer<float> reflectances;
  gpu::Buffer<uint32_t> materials_of = context().buffer(std::vector<uint32_t>{0, 1, 2}, "materials");
  LinkLimits all;

  Limits(const std::vector<float>& of_links, float least_kept)
      : floors(context().buffer(of_links, "floors")),
        left_out(context().buffer(std::vector<uint32_t>(of_links.size()), "left out")),
        reflectances(context().buffer(shares(least_kept), "reflectances")),
        all{floors, left_out, reflectances, materials_of, static_cast<uint32_t>(of_links.size()), 20, 1000} {}

  // The shares that each material reflects: the less, the nearer the wave is to the normal.
  static std::vector<float> shares(float least) {
    std::vector<float> out;
    for (uint32_t i = 0; i < 3 * WT_COSINES; ++i)
      out.push_back(1 - (1 - least) * static_cast<float>(i % WT_COSINES) / (WT_COSINES - 1));
    return out;
  }
};

}  // namespace

TEST_CASE("many receivers of one listener have the points that each of them has alone, bit by bit") {
  const Street street;
  for (const auto& [before, after] : mirrors_around) {
    const std::vector<Question> questions = street.to_all(before, after);
    const auto together = solve(street.scene, {street.tx}, street.receivers, questions, 6, true);
    size_t alone = 0;
    for (size_t i = 0; i < questions.size(); ++i) {
      CAPTURE(i);
      const auto own = solve(street.scene, {street.tx}, street.receivers, {questions[i]});
      alone += own.size();
      REQUIRE(together.contains(i) == !own.empty());
      if (!own.empty()) CHECK(together.at(i).points == own.at(0).points);
    }
    CHECK(together.size() == alone);
    CHECK(alone > 2);
    CHECK(alone < questions.size());
  }
}

TEST_CASE("floors of links: the same paths are left out together and alone, and their parts are counted once") {
  const Street street;
  size_t left = 0, kept = 0;
  for (const auto& [before, after] : mirrors_around) {
    const std::vector<Question> questions = street.to_all(before, after);
    const auto all = solve(street.scene, {street.tx}, street.receivers, questions, 6, true);
    std::vector<float> floors;
    for (size_t i = 0; i < questions.size(); ++i)
      floors.push_back(i % 5 == 0 ? 0.0f : std::pow(10.0f, -6.5f + 0.5f * static_cast<float>(i % 9)));
    const Limits limits(floors, 0.1f), lossless(floors, 1);
    const auto together = solve(street.scene, {street.tx}, street.receivers, questions, 6, true, &limits.all);
    const auto by_lossless = solve(street.scene, {street.tx}, street.receivers, questions, 6, true, &lossless.all);
    const std::vector<uint32_t> parts = limits.left_out.read();
    for (size_t i = 0; i < questions.size(); ++i) {
      CAPTURE(i);
      const Limits own_limits(floors, 0.1f);
      const auto own = solve(street.scene, {street.tx}, street.receivers, {questions[i]}, 6, false, &own_limits.all);
      CHECK(together.contains(i) == !own.empty());
      CHECK(parts[i] == own_limits.left_out.read()[i]);
      CHECK(parts[i] <= 1000);
      if (floors[i] == 0) CHECK(parts[i] == 0);
      if (all.contains(i)) CHECK(together.contains(i) == (parts[i] == 0));
      if (together.contains(i)) CHECK(together.at(i).points == all.at(i).points);
      if (together.contains(i)) CHECK(by_lossless.contains(i));  // mirrors that keep less leave out more
      left += all.contains(i) && !together.contains(i);
      kept += together.contains(i) && floors[i] > 0;
    }
  }
  CHECK(left > 20);
  CHECK(kept > 20);
}
