// SPDX-License-Identifier: Apache-2.0
// Tests bends and corners of meshes: whatever is bent diffracts on both sides, however little, except right angles.
// Each wedge is also checked against all triangles around it.
#include <doctest/doctest.h>

#include "wedge_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("whatever bends diffracts on both sides; what does not is one plane") {
  const auto bent_by = [](double angle_rad) {
    const RawMesh face = quad({0, 0, 0}, {-5 * std::cos(angle_rad), 5 * std::sin(angle_rad), 0}, {0, 0, 3});
    return build({quad({0, 0, 0}, {5, 0, 0}, {0, 0, 3}), face}, {0, 1});
  };
  for (const double angle_rad : {1e-8, 1e-6, 1e-5, 4e-4, 5e-4, 9e-4, 1.1e-3, 5e-3, 0.1}) {
    CAPTURE(angle_rad);
    const Scene s = bent_by(angle_rad);
    CHECK(s.surfaces.size() == 2);
    check_contract(s);
    REQUIRE(s.wedges.size() == 8);
    for (const double exterior_rad : {pi + angle_rad, pi - angle_rad})
      CHECK(std::ranges::count_if(
                s.wedges, [&](const Wedge& w) { return std::abs(w.exterior_rad - exterior_rad) < 1e-12; }) == 1);
  }
  for (const double angle_rad : {0.0, 1e-10}) {
    const Scene s = bent_by(angle_rad);
    CHECK(s.wedges.size() == free_count(s));
    CHECK_FALSE(between(s, {0, 0, 0}, {0, 0, 3}));
  }
}

TEST_CASE("right angles need no corner, and what is nearly right has one") {
  for (const double off_rad : {0.0, 1e-10, 2e-6, 4e-6, 1e-3, -1e-3}) {
    const dvec3 second(5 * std::sin(off_rad), 5 * std::cos(off_rad), 0);
    const Scene s = build({quad({0, 0, 0}, {5, 0, 0}, {0, 0, 3}), quad({0, 0, 0}, second, {0, 0, 3})});
    CAPTURE(off_rad);
    const auto corners = std::ranges::count_if(s.wedges, [](const Wedge& w) { return w.exterior_rad < pi; });
    CHECK(corners == (std::abs(off_rad) > 3e-6));
  }
}

TEST_CASE("convex wedges come first: corners change no number of theirs") {
  const Scene s = build({l_building(), quad({10, 0, 0}, {5, 0, 0}, {0, 0, 3}), quad({10, 0, 0}, {3, 4, 0}, {0, 0, 3})});
  CHECK(std::ranges::is_sorted(s.wedges, {}, [](const Wedge& w) { return w.exterior_rad < pi; }));
  CHECK(s.wedges.back().exterior_rad < pi);
}

TEST_CASE("sheets back to back are one face, whichever of them leans by a fraction of a milliradian") {
  for (const double lean_m : {-0.004, 0.004}) {
    for (const size_t first : {0u, 1u}) {
      std::vector<RawMesh> sheets{quad({0, 0, 0}, {0, 0, 3}, {5, 0, 0}), quad({0, 0, 0}, {0, 0, 3}, {5, lean_m, 0})};
      std::swap(sheets[0], sheets[first]);
      const Scene s = build(sheets, {0, 1});
      CHECK(s.surfaces.size() == 2);
      CHECK(diffracts(s, {0, 0, 0}, {0, 0, 3}, 360 - std::atan(0.004 / 5) / degree));  // each reflects on its own side
    }
  }
}
