// SPDX-License-Identifier: Apache-2.0
// target_edges: every prefix with every point, beside the image method and the place on the edge: none that solves is
// rejected, and none is listed that is too long, whose edge is a corner or whose point is absent.
#include "passes/target_edges.hpp"

#include "passes/joined_wedges.hpp"
#include "passes/targets.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Four points among boxes and panels; point 2 is absent.
WorldState four_points() {
  WorldState out;
  const std::vector<glm::dvec3> places{{5.2, -4.4, 3.3}, {-1.1, 7.3, 6.2}, {0.4, 0.2, 9.1}, {-6.1, -5.3, 0.8}};
  for (uint32_t i = 0; i < places.size(); ++i)
    out.targets.push_back({.position_m = places[i], .instance = no_instance, .law = 0, .present = i != 2});
  return out;
}

struct Way {
  Sequence from;
  uint32_t wedge, point;
  auto operator<=>(const Way&) const = default;
};

struct Tried {
  std::set<Way> found, wanted;
  size_t pairs = 0;
};

// parts: the prefixes are taken in so many parts. interactions: see TargetEdges.
Tried try_all(const JoinWorld& world, const WorldState& points, uint32_t interactions, uint32_t parts) {
  const DeviceScene scene = make_device_scene(context(), world.scene, false, 40);
  std::vector<EndState> tx;
  for (const glm::dvec3& p : world.transmitters) tx.push_back({.position_m = p});
  // End 1 does not look for point 3.
  const RadioEnds ends = make_radio_ends(context(), tx, std::vector<EndState>(points.targets.size()),
                                         {{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 1}, {1, 2}});
  const Wedges wedges(context(), world.scene, {}, {}, true);
  Sequences set(context(), 1 << 15);
  enter(set, scene, all_sequences(2, static_cast<uint32_t>(world.quads.size()), 3), 3);
  const uint32_t node_count = set.collect(ends.transmitter_count);
  WedgePrefixes see(context());
  WedgePrefixList& list =
      see(scene, wedges.list(), ends, set.table(), set.quarters(), set.nodes(), node_count, set.counters());
  Sort sort(context());
  sort(list.keys, list.order, list.count, wedges.key_bits());
  see.place(list);
  TargetRows targets(context(), static_cast<uint32_t>(points.targets.size()), 3);
  targets.place(points);
  TargetEdges pass(context(), interactions, 0);
  WedgeCandidates candidates(context(), 3);
  const std::vector<uint64_t> table = set.table().read();
  Tried out;
  for (uint32_t k = 0; k < parts; ++k) {
    if (k > 0) set.counters().restart(&wt_counters::wedge_candidates, 0, Stage::targets);
    const uint32_t count = pass(scene, list, list.count * k / parts, list.count * (k + 1) / parts, wedges.list(), ends,
                                targets, candidates, set.counters());
    for (const wt_wedge_candidate& c : count ? candidates.list().read(0, count) : std::vector<wt_wedge_candidate>{}) {
      CHECK((c.back == WT_ROOT && c.wedges[1] == WT_NONE));
      CHECK(out.found.insert({sequence_of(table, c.node), c.wedges[0], c.receiver}).second);
    }
  }
  const auto keys = list.keys.read(0, list.count);
  const auto sorted = list.sorted.read(0, list.count);
  for (uint32_t i = 0; i < list.count; ++i) {
    if (keys[i] == WT_NONE || sorted[i].depth >= interactions) continue;
    const uint32_t number = keys[i] >> WT_WEDGE_DEPTH_BITS;
    const Wedge& wedge = world.scene.wedges[number];
    const Sequence from = sequence_of(table, sorted[i].node);
    for (uint32_t p = 0; p < points.targets.size(); ++p) {
      ++out.pairs;
      if ((from.transmitter == 1 && p == 3) || !points.targets[p].present || reference::is_corner(wedge)) continue;
      const glm::dvec3 at = points.targets[p].position_m;
      glm::dvec3 image = world.end(from.transmitter);
      for (const uint32_t s : from.surfaces) image = mirrored_by(world.scene.surfaces[s], image);
      const std::optional<glm::dvec3> over = reference::diffraction_point(wedge, image, at);
      if (over && reaches(world, from, wedge, *over) && reference::in_free_sector(wedge, *over, at))
        out.wanted.insert({from, number, p});
    }
  }
  return out;
}

}  // namespace

TEST_CASE("target_edges: all ways that solve, for every depth and in parts, and few others") {
  const JoinWorld world;
  size_t before = 0;
  for (const uint32_t interactions : {1u, 2u, 3u})
    for (const uint32_t parts : {1u, 5u}) {
      CAPTURE(interactions);
      CAPTURE(parts);
      const Tried tried = try_all(world, four_points(), interactions, parts);
      CHECK(std::ranges::includes(tried.found, tried.wanted));
      CHECK(tried.wanted.size() >= (parts == 1 ? before + 1 : before));
      CHECK(tried.found.size() < tried.pairs / 2);
      for (const Way& way : tried.found) {
        CHECK(way.point != 2);
        CHECK((way.from.transmitter == 0 || way.point != 3));
        CHECK(way.from.surfaces.size() < interactions);
        CHECK_FALSE(reference::is_corner(world.scene.wedges[way.wedge]));
      }
      before = tried.wanted.size();
    }
}
