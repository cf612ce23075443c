// SPDX-License-Identifier: Apache-2.0
// beam_visible: the sequences of surfaces that beams find, compared with those that rays meet: none that a ray meets is
// missing, and in simple worlds there are no others.
#include "passes/beam_visible.hpp"

#include "passes/beams.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The sequences of `all` that are not in `some`.
size_t missing(const std::set<Surfaces>& all, const std::set<Surfaces>& some) {
  return static_cast<size_t>(std::ranges::count_if(all, [&](const Surfaces& s) { return !some.contains(s); }));
}

}  // namespace

TEST_CASE("beam_visible: no sequence that a ray meets between loose triangles is missing") {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    const std::vector<Corners> triangles = loose_triangles(as_many(40, 12), 6, seed);
    const uint32_t depth = as_many(3, 2);
    const std::set<Surfaces> rays = met_by_rays(triangles, {0.1, -0.2, 0.3}, depth, 100000, seed);
    const SeenByBeams beams = seen_by_beams(triangles, {0.1, -0.2, 0.3}, depth);
    CHECK(rays.size() > as_many(60, 12));
    CHECK(missing(rays, beams.sequences) == 0);
    CHECK(beams.counts.left_out_sr < 1e-9);
  }
}

TEST_CASE("beam_visible: in a closed room rays and beams find the same sequences, to depth 3") {
  std::vector<Corners> triangles = room(Room::box, 1, 3);
  const uint32_t depth = as_many(3, 2);
  const std::set<Surfaces> rays = met_by_rays(triangles, {0.31, -0.72, 0.93}, depth, 400000, 4);
  const SeenByBeams beams = seen_by_beams(triangles, {0.31, -0.72, 0.93}, depth);
  CHECK(missing(rays, beams.sequences) == 0);
  // Rays miss the thinnest beams.
  CHECK(missing(beams.sequences, rays) <= beams.sequences.size() / 100);
  // A table that is far too small grows to the same set.
  CHECK(seen_by_beams(triangles, {0.31, -0.72, 0.93}, depth, 64).sequences == beams.sequences);
}

TEST_CASE("beam_visible: a wall hides what is behind it, but for a slit") {
  // A wall at x = 2 with a slit between y = 0 and y = width, and a wall behind it.
  const auto quad = [](glm::dvec3 a, glm::dvec3 u, glm::dvec3 v, std::vector<Corners>& out) {
    out.push_back({a, a + u, a + u + v});
    out.push_back({a, a + u + v, a + v});
  };
  for (const double width : {0.0, 1e-14, 1e-3}) {
    CAPTURE(width);
    std::vector<Corners> triangles;
    quad({2, -900, -900}, {0, 900, 0}, {0, 0, 1800}, triangles);
    quad({2, width, -900}, {0, 900, 0}, {0, 0, 1800}, triangles);
    quad({5, -10, -10}, {0, 20, 0}, {0, 0, 20}, triangles);
    const SeenByBeams seen = seen_by_beams(triangles, {0, 0.3, 0.1}, 1);
    const bool behind = seen.sequences.contains({4}) || seen.sequences.contains({5});
    CHECK(behind == (width == 1e-3));
    CHECK((seen.counts.left_out_sr > 5e-15) == (width == 1e-14));
    CHECK(seen.counts.left_out_sr < 1e-12);
  }
}
