// SPDX-License-Identifier: Apache-2.0
// wedge_sight: no point of a piece that is called hidden can be seen, neither past the last mirror nor past other
// surfaces, by legs against every triangle in double; and most hidden pieces are recognised.
#include "passes/wedge_sight.hpp"

#include <doctest/doctest.h>

#include <random>

#include "passes/image_method.hpp"
#include "passes/wedge_cases.hpp"
#include "passes/wedge_prefixes.hpp"
#include "reference/planes.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Quads of random places and shapes, all of whose edges diffract, and ends among them.
struct SightWorld {
  std::vector<Quad> quads;
  Scene scene;
  std::vector<EndState> transmitters;
};

SightWorld random_world(uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const auto point = [&](double size) {
    return glm::dvec3{between(-size, size), between(-size, size), between(-size, size)};
  };
  SightWorld world;
  for (int i = 0; i < 9; ++i) {
    const glm::dvec3 a = point(1), b = point(1);
    const glm::dvec3 along = between(3, 9) * glm::normalize(a), up = between(2, 8) * glm::normalize(glm::cross(a, b));
    world.quads.push_back({point(8) - 0.5 * (along + up), along, up});
  }
  world.scene = reference::scene_of_quads(world.quads);
  for (uint32_t q = 0; q < world.quads.size(); ++q)
    for (const Wedge& w : reference::free_wedges(world.quads[q], q)) world.scene.wedges.push_back(w);
  for (int i = 0; i < 3; ++i) world.transmitters.push_back({.position_m = point(9)});
  return world;
}

// Tells whether a path over these mirrors reaches the point, with no surface that blocks one of its legs.
bool sees(const SightWorld& world, const std::vector<bool>& blocks, const Sequence& s, const glm::dvec3& p) {
  const glm::dvec3 end = world.transmitters[s.transmitter].position_m;
  const auto points = image_method(world.quads, end, s.surfaces, p);
  if (!points) return false;
  return !obstructed(world.scene, end, *points, s.surfaces, p, [&](uint32_t surface) { return blocks[surface]; });
}

struct SightCount {
  size_t pieces = 0, unseen = 0, hidden = 0;             // unseen: at all points that were tried; hidden: so called
  size_t points = 0, seen_points = 0, shown_points = 0;  // shown: between the first and the final place of the prefix
};

SightCount check(const SightWorld& world, bool transmission) {
  std::vector<bool> blocks(world.scene.surfaces.size(), true);
  for (size_t s = 0; transmission && s < blocks.size(); ++s) blocks[s] = s % 3 == 0;
  const DeviceScene scene = make_device_scene(context(), world.scene, false, 40, blocks);
  const RadioEnds ends = make_radio_ends(context(), world.transmitters, world.transmitters, {{0, 1}}, {});
  const Wedges wedges(context(), world.scene, {}, {}, true);
  Sequences set(context(), 1 << 12);
  enter(set, scene, all_sequences(3, 9, 3), 3);
  const uint32_t node_count = set.collect(ends.transmitter_count);
  WedgePrefixes prefixes(context());
  WedgePrefixList& list =
      prefixes(scene, wedges.list(), ends, set.table(), set.quarters(), set.nodes(), node_count, set.counters());
  const std::vector<uint32_t> keys = list.keys.read(0, list.count);
  WedgeSight sight(context(), scene, world.scene, transmission);
  sight(scene, wedges.list(), set.table(), list);
  const std::vector<uint32_t> after = list.keys.read(0, list.count);
  const std::vector<uint64_t> table = set.table().read();
  const auto seen = list.prefixes.read(0, list.count);
  SightCount count;
  for (uint32_t i = 0; i < list.count; ++i) {
    CHECK(after[i] == (seen[i].pieces ? keys[i] : WT_NONE));
    const Sequence sequence = sequence_of(table, seen[i].node);
    const Wedge& wedge = world.scene.wedges[keys[i] >> WT_WEDGE_DEPTH_BITS];
    for (uint32_t piece = 0; piece < WT_WEDGE_PIECES; ++piece, ++count.pieces) {
      bool any = false;
      for (int k = 0; k <= 8; ++k, ++count.points) {
        const double x = wedge.length_m * (piece + k / 8.0) / WT_WEDGE_PIECES;
        const bool sees_it = sees(world, blocks, sequence, wedge.start + x * wedge.along);
        const bool shown = seen[i].pieces && x >= seen[i].first && x <= seen[i].final;
        CHECK_FALSE((sees_it && !shown));
        count.seen_points += sees_it;
        count.shown_points += shown;
        any = any || sees_it;
      }
      const bool hidden = !(seen[i].pieces >> piece & 1);
      CHECK_FALSE((hidden && any));
      count.unseen += !any;
      count.hidden += hidden;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("random worlds, no mirror to two: no piece that is seen is called hidden, and most of the others are") {
  SightCount all;
  for (uint64_t seed = 1; seed <= as_many(6, 2); ++seed) {
    CAPTURE(seed);
    const SightCount one = check(random_world(seed), false);
    all.pieces += one.pieces;
    all.unseen += one.unseen;
    all.hidden += one.hidden;
    all.points += one.points;
    all.seen_points += one.seen_points;
    all.shown_points += one.shown_points;
  }
  MESSAGE(all.seen_points, " of ", all.points, " points are seen, ", all.shown_points, " are between the places");
  CHECK(all.seen_points > 1000);
  CHECK(all.shown_points < 3 * all.seen_points);
  MESSAGE(all.hidden, " of ", all.pieces, " pieces are called hidden, ", all.unseen, " are not seen");
  CHECK(all.pieces > 10'000);
  CHECK(all.hidden <= all.unseen);
  CHECK(static_cast<double>(all.hidden) > 0.5 * static_cast<double>(all.unseen));
}

TEST_CASE("where waves pass walls, only those that nothing passes hide") {
  const SightWorld world = random_world(11);
  const SightCount all = check(world, false), some = check(world, true);
  CHECK(some.hidden < all.hidden);
  CHECK(some.hidden > 0);
}
