// SPDX-License-Identifier: Apache-2.0
// wedge_join: of all pairs of prefixes that see one wedge, none that solves exactly is rejected, and none is listed
// whose link is not computed, or that is too long or a repetition.
#include "passes/wedge_join.hpp"

#include "passes/joined_wedges.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("one wedge: all that solves is a candidate, most of the rest is not, for every depth and link") {
  const JoinWorld world;
  size_t before = 0;
  for (const uint32_t max_depth : {1u, 2u, 3u}) {
    CAPTURE(max_depth);
    const Run run = join(world, 2, max_depth, false);
    const JoinCount count = check(world, run, max_depth, false);
    CHECK(count.solved > before);
    CHECK(run.candidates.size() < count.allowed / (max_depth == 3 ? 4 : 1));
    before = count.solved;
  }
}

TEST_CASE("ends on the line of an edge, and far away, are not rejected by rounding") {
  JoinWorld world;
  const Wedge& w = world.scene.wedges[3];
  world.transmitters = {w.start - 700.0 * w.along + glm::dvec3{1e-3, 2e-3, 0}, w.start + 0.4 * w.along};
  world.receivers = {
      w.start + (w.length_m + 900) * w.along + glm::dvec3{2e-3, 1e-3, 0}, {2500, 1800, 400}, world.transmitters[1]};
  CHECK(check(world, join(world, 1, 2, false), 2, false).solved > 0);
}

TEST_CASE("one wedge: no links, no candidates; an end that does not launch is met by none") {
  JoinWorld world;
  world.links.clear();
  CHECK(join(world, 1, 3, false).candidates.empty());
  world = {};
  world.receiver_of_origin[2] = WT_NONE;
  const Run run = join(world, 1, 2, false);
  CHECK_FALSE(run.candidates.empty());
  for (const Joined& candidate : run.candidates) CHECK(candidate.receiver != 1);
}
