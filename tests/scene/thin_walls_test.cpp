// SPDX-License-Identifier: Apache-2.0
// Edges of screens, of walls of millimetres and of doubled walls.
// Scenes consist of separate meshes, welded along their sides or not, so that most edges have faces of several meshes.
#include "scene/scene_wedges.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include "scene/info.hpp"
#include "wedge_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Approx;

TEST_CASE("a thin screen has free edges only") {
  const Scene s = build({quad({0, 0, 0}, {0, 4, 0}, {0, 0, 2})});
  check_contract(s);
  CHECK(s.wedges.size() == 4);
  CHECK(free_count(s) == 4);
  CHECK(diffracts(s, {0, 0, 2}, {0, 4, 2}, 360));
}

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

TEST_CASE("a wall that is doubled, overlaps or leaves a gap of millimetres is one wall") {
  struct Expected {
    double x;
    size_t wedges;  // 12 where vertices are welded; otherwise each facade is two surfaces and each long edge two wedges
  };
  for (const auto& [x, wedges] : {Expected{3.9991, 12}, {4.0009, 12}, {3.9985, 16}, {4.0015, 16}}) {
    CAPTURE(x);
    const Scene s = build({box({0, 0, 0}, {4, 3, 2}), box({x, 0, 0}, {8, 3, 2})});
    check_contract(s, 2e-3);
    CHECK(s.wedges.size() == wedges);
    for (const Wedge& w : s.wedges) CHECK(w.exterior_rad == Approx(1.5 * pi).epsilon(1e-15));
  }
  CHECK(build({box({0, 0, 0}, {4, 3, 2}), box({4.02, 0, 0}, {8, 3, 2})}).wedges.size() == 24);
}
