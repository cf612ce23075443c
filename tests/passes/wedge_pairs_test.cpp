// SPDX-License-Identifier: Apache-2.0
// wedge_pairs: of all pairs of prefixes that see a wedge each, none that solves exactly is left out unless something is
// in its way, and none is listed whose link is not computed, or that is too long or a repetition.
#include "passes/wedge_pairs.hpp"

#include "passes/joined_wedges.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("wedge_pairs: all that solves is a candidate, and pairs that do not see each other are not") {
  const JoinWorld world;
  const Run run = join(world, 0, 2, true);
  const JoinCount count = check(world, run, 2, true);
  CHECK(count.solved > 100);
  CHECK(count.hidden > 10);
  CHECK(run.candidates.size() < count.allowed);
  JoinWorld more;
  more.receivers.push_back({0.4, -7.2, 4.9});
  more.links.push_back({0, 3});
  more.links.push_back({1, 3});
  more.listeners.push_back(3);
  more.receiver_of_origin.push_back(3);
  const Run deeper = join(more, 1, 3, true);
  CHECK(check(more, deeper, 3, true).solved > count.solved);
  more.links.resize(as_many(7, 5));
  CHECK(join(more, 2, 5, true).candidates.size() > (1 << 14));  // the list has grown
  const Run one = join(world, 0, 1, false);
  for (const Joined& candidate : join(world, 0, 1, true).candidates) CHECK(one.candidates.contains(candidate));
}

TEST_CASE("wedge_pairs: no links, no candidates; an end that does not launch is met by none") {
  JoinWorld world;
  world.links.clear();
  CHECK(join(world, 1, 3, true).candidates.empty());
  world = {};
  world.receiver_of_origin[2] = WT_NONE;
  const Run run = join(world, 1, 2, true);
  CHECK_FALSE(run.candidates.empty());
  for (const Joined& candidate : run.candidates) CHECK(candidate.receiver != 1);
}

TEST_CASE("wedge_pairs: what is kept about two wedges changes no candidate, nor do parts of the prefixes") {
  const JoinWorld world;
  const std::set<Joined> once = join(world, 0, 2, true).candidates;
  CHECK(std::ranges::any_of(once, [](const Joined& c) { return c.wedges[1] != WT_NONE; }));
  CHECK(join(world, 0, 2, true, 1, 2).candidates == once);
  CHECK(join(world, 0, 2, true, 7, 2).candidates == once);
}

TEST_CASE("wedge_pairs: two parallel edges in free space see each other unless a wall stands between them") {
  // Half planes that stand on z = 0 at x = -2 and x = 2; the wall at x = 0 is higher than both.
  const Quad left{{-2, -5, 0}, {0, 10, 0}, {0, 0, 3}}, right{{2, -5, 0}, {0, 10, 0}, {0, 0, 3}},
      wall{{0, -50, -50}, {0, 100, 0}, {0, 0, 100}};
  for (const bool hidden : {false, true}) {
    CAPTURE(hidden);
    JoinWorld world;
    world.quads = {left, right};
    if (hidden) world.quads.push_back(wall);
    world.scene = reference::scene_of_quads(world.quads);
    for (const uint32_t panel : {0u, 1u})
      for (const Wedge& w : reference::free_wedges(world.quads[panel], panel)) world.scene.wedges.push_back(w);
    world.transmitters = {{-6, 0.5, 1}};
    world.receivers = {{6, -0.5, 1}};
    world.links = {{0, 0}};
    world.listeners = {0};
    world.receiver_of_origin = {WT_NONE, 0};
    // The third edge of a quad is its upper one: wedges 2 and 4 + 2.
    const Joined over{{0, {}}, {1, {}}, {2, 6}, 0};
    CHECK(join(world, 0, 2, true).candidates.contains(over) == !hidden);
  }
}
