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

void quad(glm::dvec3 a, glm::dvec3 u, glm::dvec3 v, std::vector<Corners>& out) {
  out.push_back({a, a + u, a + u + v});
  out.push_back({a, a + u + v, a + v});
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

TEST_CASE("beam_waiting: a mosaic of panels hides a wall, but for the place of a panel that lacks") {
  const uint32_t side = as_many(40, 6);
  for (const bool whole : {true, false}) {
    CAPTURE(whole);
    std::vector<Corners> triangles;
    quad({3, -4.2, -4.2}, {0, 8.4, 0}, {0, 0, 8.4}, triangles);
    const auto at = [&](uint32_t i) { return -1.5 + 3.0 * i / side; };
    for (uint32_t i = 0; i < side; ++i)
      for (uint32_t j = 0; j < side; ++j)
        if (whole || i != side / 3 || j != side / 2) {
          const glm::dvec3 a(1, at(i), at(j)), b(1, at(i + 1), at(j)), c(1, at(i + 1), at(j + 1)),
              d(1, at(i), at(j + 1));
          triangles.push_back({a, b, c});
          triangles.push_back({a, c, d});
        }
    // The panels cover the wall, so only a hole shows it.
    const SeenByBeams seen = seen_by_beams(triangles, {0, 0.013, 0.027}, 1);
    CHECK((seen.sequences.contains({0}) || seen.sequences.contains({1})) != whole);
    CHECK(seen.counts.left_out_sr < 1e-10);
    for (uint32_t t = 2; t < triangles.size(); ++t) {
      const bool in_face = std::ranges::all_of(
          triangles[t], [](const glm::dvec3& p) { return std::abs(p.y - 0.013) < 1 && std::abs(p.z - 0.027) < 1; });
      if (in_face) CHECK(seen.sequences.contains({t}));
    }
  }
}

TEST_CASE("beam_visible: waves pass as many walls as they may, and two faces of one wall count once") {
  // Walls across the x axis that fill the view.
  const auto walls_at = [](const std::vector<double>& places) {
    std::vector<Corners> out;
    for (const double x : places) out.push_back({glm::dvec3(x, -90, -90), {x, 290, -90}, {x, -90, 290}});
    return out;
  };
  const auto seen = [&](const std::vector<double>& places, uint32_t max_depth, uint32_t max_transmissions) {
    const SeenByBeams all = seen_by_beams(walls_at(places), {0, 0.1, 0.2}, max_depth, 1 << 16, max_transmissions);
    size_t first = 0;
    for (const Surfaces& s : all.sequences) first += s.size() == 1;
    return first;
  };
  CHECK(seen({1, 2, 3, 4, 5}, 5, 0) == 1);
  CHECK(seen({1, 2, 3, 4, 5}, 5, 1) == 2);
  CHECK(seen({1, 2, 3, 4, 5}, 5, 2) == 3);
  // A transmission counts as an interaction.
  CHECK(seen({1, 2, 3, 4, 5}, 3, 9) == 3);
  CHECK(seen({1, 2, 3, 4, 5}, 1, 9) == 1);
  // Faces that are 0.05 mm apart are one wall, in any order; those that are 10 cm apart are two.
  CHECK(seen({1, 1.00005, 2, 3}, 5, 1) == 3);
  CHECK(seen({2, 3, 1.00005, 1}, 5, 1) == 3);
  CHECK(seen({1, 1.1, 2, 3}, 5, 1) == 2);
}
