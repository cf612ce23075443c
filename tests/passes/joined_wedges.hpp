// SPDX-License-Identifier: Apache-2.0
// Candidates of diffracted paths of a small world, made by wedge_join alone or with wedge_pairs, and a check of every
// pair of prefixes. The exact solve is the reference's bisection and image method.
#pragma once
#include <doctest/doctest.h>

#include <optional>
#include <set>

#include "passes/image_method.hpp"
#include "passes/sort.hpp"
#include "passes/wedge_cases.hpp"
#include "passes/wedge_join.hpp"
#include "passes/wedge_prefixes.hpp"
#include "passes/wedges.hpp"
#include "reference/planes.hpp"
#include "reference/wedge_points.hpp"

namespace wavetracer::test {

struct Joined {
  Sequence from, to;
  uint32_t wedges[2], receiver;
  auto operator<=>(const Joined&) const = default;
};

struct JoinWorld {
  std::vector<Quad> quads = box_and_panel_quads();
  Scene scene = box_and_panels();
  std::vector<glm::dvec3> transmitters{{-7.1, 1.3, 2.2}, {6.3, 5.9, 1.1}};
  std::vector<glm::dvec3> receivers{{5.2, -4.4, 3.3}, {-1.1, 7.3, 6.2}, {6.3, 5.9, 1.1}};
  std::vector<Link> links{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}};
  std::vector<uint32_t> listeners{1, 0};                       // origins 2 and 3
  std::vector<uint32_t> receiver_of_origin{WT_NONE, 2, 1, 0};  // transmitter 1 is receiver 2

  glm::dvec3 end(uint32_t origin) const {
    return origin < 2 ? transmitters[origin] : receivers[receiver_of_origin[origin]];
  }
};

struct Run {
  std::set<Joined> candidates;
  std::vector<std::pair<Sequence, uint32_t>> prefixes;  // and the wedge that they see
};

// parts: the prefixes that serve as those of transmitters are taken in this many parts. times: all of it is done so
// often, with what wedge_pairs has kept; the last time counts.
inline Run join(const JoinWorld& world, uint32_t prefix_depth, uint32_t max_depth, bool pairs, uint32_t parts = 1,
                uint32_t times = 1) {
  const DeviceScene scene = make_device_scene(context(), world.scene, false, 40);
  std::vector<EndState> tx, rx;
  for (const glm::dvec3& p : world.transmitters) tx.push_back({.position_m = p});
  for (const glm::dvec3& p : world.receivers) rx.push_back({.position_m = p});
  RadioEnds ends = make_radio_ends(context(), tx, rx, world.links, single_listeners(world.listeners));
  ends.receiver_of_end = context().buffer(world.receiver_of_origin, "receivers of ends");
  const Wedges wedges(context(), world.scene, {}, {}, true);
  Sequences set(context(), 1 << 15);
  const auto origins = static_cast<uint32_t>(world.receiver_of_origin.size());
  enter(set, scene, all_sequences(origins, static_cast<uint32_t>(world.quads.size()), prefix_depth + 1),
        prefix_depth + 1);
  const uint32_t node_count = set.collect(ends.transmitter_count);
  WedgePrefixes see(context());
  WedgePrefixList& list =
      see(scene, wedges.list(), ends, set.table(), set.quarters(), set.nodes(), node_count, set.counters());
  const std::vector<uint32_t> seen = list.keys.read(0, list.count);  // before those that see nothing are dropped
  std::optional<WedgePairs> two;
  if (pairs) two.emplace(context(), scene, world.scene, false);
  if (two) two->sight(scene, wedges.list(), set.table(), list);
  Sort sort(context());
  sort(list.keys, list.order, list.count, wedges.key_bits());
  see.place(list);
  if (two) two->list_runs(wedges.list(), list);
  WedgeJoin pass(context(), max_depth);
  WedgeCandidates found(context(), max_depth);
  Run out;
  const std::vector<uint64_t> table = set.table().read();
  const auto keys = list.keys.read(0, list.count);
  const auto prefixes = list.prefixes.read(0, list.count), sorted = list.sorted.read(0, list.count);
  CHECK(std::ranges::is_sorted(keys));
  for (uint32_t i = 0; i < list.count; ++i) {
    out.prefixes.emplace_back(sequence_of(table, prefixes[i].node), seen[i] >> 5);
    CHECK((keys[i] == WT_NONE || (keys[i] & 31) == sorted[i].depth));
  }
  for (uint32_t k = 0; k < parts * times; ++k) {
    if (k % parts == 0) out.candidates.clear();
    if (k > 0) set.counters().restart(&wt_counters::wedge_candidates, 0, Stage::wedge_join);
    const uint32_t first = list.count * (k % parts) / parts, end = list.count * (k % parts + 1) / parts;
    const uint32_t count =
        pass(scene, list, first, end, wedges.list(), ends, two ? &*two : nullptr, found, set.counters());
    for (const wt_wedge_candidate& c : count ? found.list().read(0, count) : std::vector<wt_wedge_candidate>{})
      CHECK(
          out.candidates
              .insert({sequence_of(table, c.node), sequence_of(table, c.back), {c.wedges[0], c.wedges[1]}, c.receiver})
              .second);
  }
  return out;
}

// Tells whether there is a path from an end over the reflections to a point of the edge, in its free sector.
inline bool reaches(const JoinWorld& world, const Sequence& s, const Wedge& wedge, const glm::dvec3& p) {
  if (!s.surfaces.empty()) {
    const Surface& last = world.scene.surfaces[s.surfaces.back()];
    if (std::abs(glm::dot(last.normal, p) - last.offset_m) < 1e-6) return false;
  }
  const auto points = image_method(world.quads, world.end(s.transmitter), s.surfaces, p);
  if (!points) return false;
  return reference::in_free_sector(wedge, p, points->empty() ? world.end(s.transmitter) : points->back());
}

// Tells whether nothing is in the way from the end over its reflections to the point of the edge.
inline bool sees(const JoinWorld& world, const Sequence& s, const glm::dvec3& p) {
  const glm::dvec3 end = world.end(s.transmitter);
  const auto points = image_method(world.quads, end, s.surfaces, p);
  return !obstructed(world.scene, end, *points, s.surfaces, p, [](uint32_t) { return true; });
}

struct JoinCount {
  size_t solved = 0, allowed = 0, hidden = 0;
};

// Checks every pair of prefixes. Pairs that may be joined are `allowed`; those that solve must be candidates or, if
// wedge_sight has tested them (as for paths over two wedges), hidden.
inline JoinCount check(const JoinWorld& world, const Run& run, uint32_t max_depth, bool pairs, bool tested = false) {
  JoinCount out;
  std::set<Joined> allowed;
  for (const auto& [from, v] : run.prefixes)
    for (const auto& [to, w] : run.prefixes) {
      const bool two = v != w;
      const uint32_t receiver = world.receiver_of_origin[to.transmitter];
      const size_t depth = from.surfaces.size() + to.surfaces.size() + (two ? 2 : 1);
      if ((two && !pairs) || depth > max_depth || from.transmitter >= 2 || receiver == WT_NONE) continue;
      if (std::ranges::count(world.links, Link{from.transmitter, receiver}) == 0) continue;
      const Joined joined{from, to, {v, two ? w : WT_NONE}, receiver};
      allowed.insert(joined);
      glm::dvec3 a = world.end(from.transmitter), b = world.end(to.transmitter);
      for (const uint32_t s : from.surfaces) a = mirrored_by(world.scene.surfaces[s], a);
      for (const uint32_t s : to.surfaces) b = mirrored_by(world.scene.surfaces[s], b);
      const Wedge &first = world.scene.wedges[v], &second = world.scene.wedges[w];
      glm::dvec3 p, q;
      if (two) {
        const auto points = reference::diffraction_points(first, second, a, b);
        if (!points || glm::distance((*points)[0], (*points)[1]) < 1e-4) continue;
        p = (*points)[0], q = (*points)[1];
        if (!reference::in_free_sector(first, p, q) || !reference::in_free_sector(second, q, p)) continue;
      } else {
        const auto point = reference::diffraction_point(first, a, b);
        if (!point) continue;
        p = q = *point;
      }
      if (!reaches(world, from, first, p) || !reaches(world, to, second, q)) continue;
      ++out.solved;
      if (run.candidates.contains(joined)) continue;
      ++out.hidden;
      CHECK((pairs || tested));
      CHECK_FALSE((sees(world, from, p) && sees(world, to, q) &&
                   reference::passages(world.scene, p, reference::no_surface, q, reference::no_surface).empty()));
    }
  for (const Joined& candidate : run.candidates) CHECK(allowed.contains(candidate));
  out.allowed = allowed.size();
  return out;
}

}  // namespace wavetracer::test
