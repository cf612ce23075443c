// SPDX-License-Identifier: Apache-2.0
// Free ends of edges: corners of plates and roofs are free, feet of houses and cuts are not.
#include "scene/free_ends.hpp"

#include "wavetracer/device/records.h"
#include "wedge_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Ends {
  size_t free = 0, other = 0;  // counts of the ends of convex edges
  bool operator==(const Ends&) const = default;
};

Ends ends_of(std::vector<RawMesh> meshes, std::vector<uint32_t> material = {}) {
  Scene scene = build(std::move(meshes), std::move(material));
  find_wedges(scene, EdgeSearch::of_model);
  mark_free_ends(scene);
  Ends out;
  for (const Wedge& wedge : scene.wedges) {
    const size_t free = (wedge.free_ends & WT_FREE_START ? 1 : 0) + (wedge.free_ends & WT_FREE_END ? 1 : 0);
    if (wedge.exterior_rad < 3.2) {
      CHECK(free == 0);
      continue;
    }
    out.free += free;
    out.other += 2 - free;
  }
  return out;
}

}  // namespace

TEST_CASE("all ends of a plate and of a box in the air are free") {
  CHECK(ends_of({quad({0, 0, 5}, {3, 0, 0}, {0, 0, 2})}) == Ends{8, 0});
  CHECK(ends_of({box({-3, -2, 1}, {2, 4, 5})}) == Ends{24, 0});
}

TEST_CASE("upright edges of a house end on the ground, and not freely") {
  const RawMesh ground = quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
  // Four upright edges with a foot each, four of the roof, and four of the ground's rim.
  const Ends without_ground = ends_of({box({-3, -2, 0}, {2, 4, 5}, false)});
  CHECK(ends_of({box({-3, -2, 0}, {2, 4, 5}, false), ground}) == Ends{12 + 8, 4});
  CHECK(without_ground.other == 0);
}

TEST_CASE("an edge that a second surface cuts goes on") {
  // Two plates of different materials on top of each other; the cut is flat, and four ends of the sides meet there.
  const std::vector<RawMesh> plates{quad({0, 0, 5}, {3, 0, 0}, {0, 0, 2}), quad({0, 0, 7}, {3, 0, 0}, {0, 0, 1})};
  CHECK(ends_of(plates, {0, 1}) == Ends{8, 4});
}
