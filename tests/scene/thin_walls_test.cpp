// Walls that are thinner than edges can be told apart, and what is as thin but no wall.
#include <doctest/doctest.h>

#include "wedge_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("a wall of at most 2 mm is a screen, with a word; a thicker one has two edges at its top") {
  for (const double thick_m : {0.001, 0.0015, 0.00199}) {
    CAPTURE(thick_m);
    const Scene s = build({box({0, 0, 0}, {thick_m, 4, 2})});
    check_contract(s);
    CHECK(free_count(s) == 4);
    CHECK(s.wedges.size() == 4);
    CHECK(diffracts(s, {thick_m / 2, 0, 2}, {thick_m / 2, 4, 2}, 360));
    CHECK(s.report.warnings.size() == 1);
  }
  const Scene thicker = build({box({0, 0, 0}, {0.0021, 4, 2})});
  CHECK(free_count(thicker) == 0);
  CHECK(thicker.report.warnings.empty());
  CHECK(diffracts(thicker, {0, 0, 2}, {0, 4, 2}, 270));
  for (const RawMesh& strip : {quad({0, 0, 0}, {0.001, 0, 0}, {0, 4, 0}), quad({0, 0, 0}, {0, 0, 0.001}, {0, 4, 0})})
    CHECK(build({strip}).triangles.size() == 2);
  const Scene step = build({quad({0, 0, 0}, {3, 0, 0}, {0, 4, 0}), quad({0, 0, 0}, {0, 0, 0.001}, {0, 4, 0}),
                            quad({0, 0, 0.001}, {-3, 0, 0}, {0, 4, 0})});
  CHECK(step.triangles.size() == 6);
}
