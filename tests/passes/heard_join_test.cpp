// SPDX-License-Identifier: Apache-2.0
// heard_join: if listeners have heard all that their prefixes see, its candidates are those of wedge_join between
// transmitters and listeners. If wedge_sight has tested the transmitters, it only drops pairs that cannot see the edge.
#include "passes/heard_join.hpp"

#include <doctest/doctest.h>

#include <map>

#include "passes/hear.hpp"
#include "passes/joined_wedges.hpp"
#include "passes/labelled.hpp"
#include "passes/wedge_sight.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t first_listener = 2;

// A listener hears a wedge that one of its prefixes sees, by these surfaces.
struct HeardChain {
  uint32_t listener, wedge;
  std::vector<uint32_t> surfaces;  // from the listener on
};

std::vector<HeardChain> chains_of(const Run& run) {
  std::vector<HeardChain> out;
  for (const auto& [sequence, wedge] : run.prefixes)
    if (sequence.transmitter >= first_listener)
      out.push_back({sequence.transmitter - first_listener, wedge, sequence.surfaces});
  return out;
}

// Enters the chains by hear: a ray for each crosses the square of its listener.
void hear_all(const std::vector<HeardChain>& chains, const DeviceScene& scene, Sequences& set) {
  constexpr uint32_t wedge_roots = 10;
  std::vector<Sequence> met;
  for (const HeardChain& chain : chains)
    met.push_back({wedge_roots + chain.wedge, {chain.surfaces.rbegin(), chain.surfaces.rend()}});
  Sequences by_rays(context(), 1 << 12);
  by_rays.clear();
  std::vector<Sequence> longer;
  std::ranges::copy_if(met, std::back_inserter(longer), [](const Sequence& s) { return !s.surfaces.empty(); });
  enter(by_rays, scene, longer, WT_MAX_DEPTH);
  const std::vector<uint64_t> table = by_rays.table().read();
  std::map<Sequence, uint32_t> nodes;
  for (uint32_t slot = 0; slot < table.size(); ++slot)
    if (table[slot] != WT_EMPTY) nodes[sequence_of(table, slot)] = slot;
  for (uint32_t listener = 0; listener < 2; ++listener) {
    std::vector<LabelledRay> rays;
    for (size_t i = 0; i < chains.size(); ++i) {
      if (chains[i].listener != listener) continue;
      LabelledRay ray{ray_towards({0.5, 0.5, 3}, {0, 0, -1}), 0, 0, {}};
      ray.ray.node = met[i].surfaces.empty() ? WT_ROOT | met[i].transmitter : nodes.at(met[i]);
      ray.ray.node |= 1u << WT_QUARTER_SHIFT;
      rays.push_back(ray);
    }
    const ListenerMap map{.listeners = context().buffer(std::vector<uint32_t>{listener}, "listeners"),
                          .heights = context().buffer(std::vector<float>{0, 1}, "heights"),
                          .x_m = 0,
                          .y_m = 0,
                          .size_m = 1,
                          .columns = 1,
                          .rows = 1,
                          .low_m = 0,
                          .high_m = 1};
    Hear hear(context(), wedge_roots, first_listener, 1);
    const RayQueue queue = upload_labelled(rays);
    const HitList hits = upload_hits_of(rays);
    for (hear(queue, hits, by_rays.table(), map, set.trie()); set.overflowed();) {
      set.regrow(WT_MAX_DEPTH);
      hear(queue, hits, by_rays.table(), map, set.trie());
    }
  }
}

// As join(), by heard_join. tested: wedge_sight tests the prefixes of transmitters. parts: of the nodes.
Run join_heard(const JoinWorld& world, const Run& all, uint32_t prefix_depth, uint32_t max_depth, bool tested,
               uint32_t parts) {
  const DeviceScene scene = make_device_scene(context(), world.scene, false, 40);
  std::vector<EndState> tx, rx;
  for (const glm::dvec3& p : world.transmitters) tx.push_back({.position_m = p});
  for (const glm::dvec3& p : world.receivers) rx.push_back({.position_m = p});
  RadioEnds ends = make_radio_ends(context(), tx, rx, world.links, single_listeners(world.listeners));
  ends.receiver_of_end = context().buffer(world.receiver_of_origin, "receivers of ends");
  const Wedges wedges(context(), world.scene, {}, {}, true);
  Sequences set(context(), 1 << 15);
  set.clear();
  enter(set, scene, all_sequences(2, static_cast<uint32_t>(world.quads.size()), prefix_depth + 1), prefix_depth + 1);
  hear_all(chains_of(all), scene, set);
  // The nodes of transmitters: those of the set whose root is one.
  const uint32_t node_count = set.collect(ends.transmitter_count);
  const std::vector<uint64_t> table = set.table().read();
  std::vector<uint32_t> own;
  for (const uint32_t node : set.nodes().read(0, node_count))
    if (!(node & WT_ROOT) && sequence_of(table, node).transmitter < first_listener) own.push_back(node);
  WedgePrefixes see(context());
  const gpu::Buffer<uint32_t> own_nodes = context().buffer(own, "nodes of transmitters");
  set.counters().restart_nodes(static_cast<uint32_t>(own.size()), Stage::sequences);
  WedgePrefixList& list = see(scene, wedges.list(), ends, set.table(), set.quarters(), own_nodes,
                              static_cast<uint32_t>(own.size()), set.counters());
  WedgeSight sight(context(), scene, world.scene, false, most_pieces);
  if (tested) sight(scene, wedges.list(), set.table(), list);
  Sort sort(context());
  sort(list.keys, list.order, list.count, wedges.key_bits());
  see.place(list);
  const uint32_t in_sight = sight.in_sight(list);
  CHECK((tested ? in_sight < list.count : in_sight == list.count));
  HeardJoin pass(context(), max_depth, most_pieces, 0);
  WedgeCandidates found(context(), max_depth);
  Run out;
  for (uint32_t part = 0; part < parts; ++part) {
    set.counters().restart(&wt_counters::wedge_candidates, 0, Stage::heard_join);
    const HeardNodes nodes{set.table(), set.quarters(), set.nodes(), node_count * part / parts,
                           node_count * (part + 1) / parts};
    const uint32_t count = pass(scene, list, in_sight, nodes, wedges.list(), ends, found, set.counters());
    for (const wt_wedge_candidate& c : count ? found.list().read(0, count) : std::vector<wt_wedge_candidate>{}) {
      CHECK(c.wedges[1] == WT_NONE);
      const Joined joined{
          sequence_of(table, c.node), sequence_of(table, c.back), {c.wedges[0], c.wedges[1]}, c.receiver};
      CHECK(out.candidates.insert(joined).second);
    }
  }
  return out;
}

// The candidates between transmitters and listeners.
std::set<Joined> with_listeners(const std::set<Joined>& candidates) {
  std::set<Joined> out;
  for (const Joined& candidate : candidates)
    if (candidate.to.transmitter >= first_listener) out.insert(candidate);
  return out;
}

}  // namespace

TEST_CASE("what listeners have heard makes the candidates of wedge_join, for every depth, also in parts") {
  const JoinWorld world;
  for (const uint32_t max_depth : {1u, 2u, 3u}) {
    CAPTURE(max_depth);
    const Run all = join(world, 2, max_depth, false);
    const std::set<Joined> wanted = with_listeners(all.candidates);
    CHECK(wanted.size() > 10);
    for (const uint32_t parts : {1u, 3u})
      CHECK((join_heard(world, all, 2, max_depth, false, parts).candidates == wanted));
  }
}

TEST_CASE("transmitters that wedge_sight has tested: what is dropped cannot be seen, and something is dropped") {
  const JoinWorld world;
  Run all = join(world, 2, 3, false);
  Run tested = join_heard(world, all, 2, 3, true, 1);
  CHECK(tested.candidates.size() < with_listeners(all.candidates).size());
  for (const Joined& candidate : all.candidates)  // transmitters that receive are not heard
    if (candidate.to.transmitter < first_listener) tested.candidates.insert(candidate);
  tested.prefixes = all.prefixes;
  const JoinCount count = check(world, tested, 3, false, true);
  CHECK(count.solved > count.hidden);
  CHECK(count.hidden > 0);
}

TEST_CASE("without links nothing is joined, and without transmitters that see the wedge neither") {
  JoinWorld world;
  const Run all = join(world, 1, 2, false);
  world.links.clear();
  CHECK(join_heard(world, all, 1, 2, false, 1).candidates.empty());
  world = {};
  CHECK(join_heard(world, {}, 1, 2, false, 1).candidates.empty());
}
