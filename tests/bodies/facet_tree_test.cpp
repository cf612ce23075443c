// SPDX-License-Identifier: Apache-2.0
// The tree of spheres against a loop over all of them, and a body that is asked often against one that is made anew.
#include "bodies/facet_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "bodies/bodies.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

TEST_CASE("the tree visits each sphere that touches a ball once, and no other one") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const size_t count : {0, 1, 4, 5, 300}) {
    std::vector<Sphere> spheres;
    for (size_t i = 0; i < count; ++i)
      spheres.push_back({{unit(random), i % 3 ? unit(random) : 0.25, unit(random)}, 0.1 * std::abs(unit(random))});
    const FacetTree tree(spheres);
    for (int trial = 0; trial < 50; ++trial) {
      const glm::dvec3 ball(unit(random), unit(random), unit(random));
      const double radius_m = 0.4 * std::abs(unit(random));
      const auto touches = [&](const Sphere& s) { return glm::length(s.centre - ball) <= s.radius_m + radius_m; };
      std::vector<uint32_t> found, expected;
      tree.visit(touches, [&](uint32_t i) {
        if (touches(spheres[i])) found.push_back(i);
      });
      for (uint32_t i = 0; i < count; ++i)
        if (touches(spheres[i])) expected.push_back(i);
      std::ranges::sort(found);
      CHECK(found == expected);
    }
  }
}

TEST_CASE("a body that is prepared once has the bits of one that is made for each direction") {
  const Body one = box({0.06, 0.05, 0.04});
  const ScatteringBody prepared(one);
  for (const double phi : {10.0, 55.0, 130.0}) {
    const glm::dvec3 from = towards(70, phi), to = towards(100, phi + 20);
    CHECK(prepared.cross_sections_m2(from, to, wave_hz) == cross_sections_m2(one, from, to, wave_hz));
    const auto echoes = prepared.scattered(from, to, wave_hz), others = scattered(one, from, to, wave_hz);
    REQUIRE(echoes.size() == others.size());
    for (size_t i = 0; i < echoes.size(); ++i) CHECK(echoes[i].matrix == others[i].matrix);
  }
  CHECK_THROWS_AS(ScatteringBody(Body{}), InputError);
}
