// SPDX-License-Identifier: Apache-2.0
// Edges of scenes whose corners are rounded to float32, half a kilometre from the middle: they lie in the planes of
// their faces, where the reflections end that they make up for.
#include <doctest/doctest.h>

#include "scene/scene_wedges.hpp"
#include "wedge_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

RawMesh turned_box(double turn_rad) {
  RawMesh mesh = box({-700, -450, 0}, {650, 550, 150});
  for (auto& p : mesh.vertices) {
    const double x = p.x * std::cos(turn_rad) - p.y * std::sin(turn_rad);
    const double y = p.x * std::sin(turn_rad) + p.y * std::cos(turn_rad);
    p = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(p.z + 0.02 * x)};
  }
  return mesh;
}

}  // namespace

TEST_CASE("edges of rounded corners lie in the planes of both of their faces") {
  for (const double turn_rad : {0.37, 1.9, 4.4}) {
    const Scene s = build({turned_box(turn_rad)});
    size_t right_angles = 0;
    for (const Wedge& w : s.wedges) {
      if (std::abs(w.exterior_rad - 1.5 * pi) > 0.1) continue;  // walls may bend a little where they are rounded
      ++right_angles;
      for (const uint32_t surface : w.surface)
        for (const double x : {0.0, w.length_m}) {
          const auto& plane = s.surfaces[surface];
          CHECK(std::abs(glm::dot(plane.normal, w.start + x * w.along) - plane.offset_m) < 1e-9);
        }
    }
    CHECK(right_angles >= 12);
  }
}
