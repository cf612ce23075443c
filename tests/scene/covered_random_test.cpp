// SPDX-License-Identifier: Apache-2.0
// Random meshes of several materials in one plane, against the smallest mesh that holds a point.
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "painted.hpp"

using namespace wavetracer;
using glm::dvec3;
using test::Painted;

TEST_CASE("random meshes of one plane in random order: the smallest at every place, and no bend") {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int run = 0; run < 40; ++run) {
    CAPTURE(run);
    const glm::dquat turn =
        glm::angleAxis(3 * share(random), glm::normalize(dvec3(share(random), share(random), share(random)) + 0.1));
    std::vector<Painted> parts;  // the largest one first
    for (int i = 0; i < 6; ++i) {
      const double size_m = 60 - 9.5 * i, angle = i == 0 ? 0 : 6 * share(random);
      const dvec3 u(std::cos(angle) * size_m, std::sin(angle) * size_m, 0), v(-u.y * 0.7, u.x * 0.7, 0);
      const dvec3 middle = i == 0 ? dvec3(0) : dvec3(30 * share(random) - 15, 30 * share(random) - 15, 0);
      const auto count = [&] { return 1 + static_cast<uint32_t>(4 * share(random)); };
      RawMesh part = test::cells(middle - (u + v) / 2.0, u, v, count(), count());
      for (dvec3& p : part.vertices) p = turn * p;
      parts.push_back({i % 2 == 0 ? part : test::turned_over(part), std::string(1, static_cast<char>('a' + i))});
    }
    std::vector<Painted> shuffled = parts;
    std::ranges::shuffle(shuffled, random);
    const Scene s = test::build_painted(shuffled);
    CHECK(std::ranges::all_of(s.wedges, test::is_free));
    for (int k = 0; k < 100; ++k) {
      const dvec3 p = turn * dvec3(60 * share(random) - 30, 42 * share(random) - 21, 0);
      std::string expected;
      for (const Painted& part : parts)
        if (test::holds(part.mesh, p)) expected = part.material;
      CHECK(test::materials_at(s, p) == std::vector<std::string>{expected});
    }
  }
}
