// SPDX-License-Identifier: Apache-2.0
// A line's comment names the passes that it runs.
#include "simulation/solve_paths.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace wavetracer {
namespace {

constexpr uint32_t few_edges = 16;

// Enters sequences beside those that rays have found; wedges must have run. Returns the number of nodes, which was
// `nodes` before.
uint32_t enter_neighbours(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                          uint32_t nodes) {
  return set.extend(nodes, exact.max_depth, [&](const Sequences::Found& found) {
    set.commute(scene.surfaces, found);  // sequences
    if (!exact.diffraction) return;
    exact.diffraction->grazed_faces(scene, exact.diffraction->wedges.list(), ends, found);  // grazed_faces
  });
}

// Lists the prefixes of transmitters that see something of their edges. nodes: those of transmitters.
void list_heard_edges(DiffractedPaths& edges, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                      uint32_t nodes) {
  set.counters().restart_nodes(nodes, Stage::sequences);  // regrow() has set all counters to zero
  set.counters().restart(&wt_counters::wedge_prefixes, 0, Stage::wedge_prefixes);
  WedgePrefixList& prefixes = edges.prefixes(scene, edges.wedges.list(), ends, set.table(), set.quarters(), set.nodes(),
                                             nodes, set.counters());      // wedge_prefixes
  edges.heard->sight(scene, edges.wedges.list(), set.table(), prefixes);  // wedge_sight
  edges.sort(prefixes);                                                   // sort, wedge_prefixes
  edges.heard->in_sight = edges.heard->sight.in_sight(prefixes);          // wedge_sight
}

// Adds what listeners hear of the edges that transmitters see; wedges must have run. nodes: the length of the list of
// nodes, which stays.
DiscoveryCounts hear_edges(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                           uint32_t nodes, Search search) {
  DiffractedPaths& edges = *exact.diffraction;
  list_heard_edges(edges, scene, ends, set, nodes);
  const size_t room = set.table().size();
  const uint32_t launching = search == Search::few ? std::min(edges.heard->in_sight, few_edges) : edges.heard->in_sight;
  const DiscoveryCounts rays = exact.from_edges->find(scene, edges.prefixes.list(), edges.wedges.list(), launching,
                                                      nodes, set);                   // edge_rays to hear
  if (set.table().size() != room) list_heard_edges(edges, scene, ends, set, nodes);  // their nodes have moved
  set.counters().restart_nodes(nodes, Stage::sequences);
  return rays;
}

// Makes the paths over one edge or two. nodes: the number of nodes; see, told: as for join_by_parts, told with the
// number of all items as well. Returns the counts that the counters lack.
template <class See, class Told>
Uncounted join_edges(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set, uint32_t nodes,
                     const See& see, const Told& told) {
  DiffractedPaths& edges = *exact.diffraction;
  if (exact.from_edges) {
    nodes = set.collect(ends.transmitter_count);  // sequences
    return join_heard(edges, scene, ends, set, nodes, see, [&](uint32_t done) { told(done, nodes); });
  }
  WedgePrefixList& prefixes = edges.prefixes(scene, edges.wedges.list(), ends, set.table(), set.quarters(), set.nodes(),
                                             nodes, set.counters());                       // wedge_prefixes
  if (edges.pairs) edges.pairs->sight(scene, edges.wedges.list(), set.table(), prefixes);  // wedge_sight
  edges.sort(prefixes);  // sort, wedge_prefixes, wedge_pairs
  return join_prefixes(edges, scene, ends, set, prefixes, see, [&](uint32_t done) { told(done, prefixes.count); });
}

// The edges and prefixes of join_edges.
SeenEdges seen_edges(DiffractedPaths& edges) { return {edges.wedges.list(), edges.prefixes.list(), edges.candidates}; }

// Makes the paths over tiles with reflections and edges around them. take: takes paths whose legs have been tested;
// told: as for join_edges, with numbers of tiles. The prefixes of join_edges must be there. Returns their counts.
template <class Take, class Told>
JoinedCounts join_tiles(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                        uint32_t nodes, const Take& take, const Told& told) {
  const TileBuffers& tiles = exact.scatter->tiles();
  const FoundSequences found{set.table(), set.quarters(), set.nodes(), nodes};
  const auto beside_edges = [&] {
    if (!exact.scattered_edges) return JoinedCounts{};
    return (*exact.scattered_edges)(
        scene, tiles, ends, found, seen_edges(*exact.diffraction), exact.scattered->prefixes,
        [&](SolvedList& rows, Counters& counters) { exact.check_legs(scene, ends, rows, counters, false); }, take);
  };
  return join_points(
      *exact.scattered, scene, tiles, ends, found, set.counters(),
      [&](SolvedList& rows) { exact.check_legs(scene, ends, rows, set.counters()); }, take, beside_edges,
      [&](uint32_t done) { told(done, tiles.count); });
}

// Makes the paths over targets with reflections and edges around them; take: as for join_tiles. The prefixes of
// join_edges must be there. Returns their counts.
template <class Take>
JoinedCounts chain_targets(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                           uint32_t nodes, const Take& take) {
  // The list of nodes is as long as the counters say, where `nodes` is a bound of it.
  const wt_counters now = set.counters().read(Stage::targets);
  std::optional<SeenEdges> edges;
  if (exact.target_chains->takes_edges()) edges.emplace(seen_edges(*exact.diffraction));
  return (*exact.target_chains)(
      scene, ends, {set.table(), set.quarters(), set.nodes(), std::min(nodes, now.nodes + now.exchanged)},
      *exact.targets, edges ? &*edges : nullptr,
      [&](SolvedList& ways, const RadioEnds& between, Counters& counters) {
        exact.check_legs(scene, between, ways, counters, false);
      },
      take);
}

// Makes all paths over targets. see: takes rows whose legs have not been tested; take: as for join_tiles; tell: is
// called after each kind.
template <class See, class Take, class Tell>
void solve_targets(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set, uint32_t nodes,
                   const See& see, const Take& take, const Tell& tell, Uncounted& out) {
  see((*exact.targets)(scene, ends));  // targets
  out.weak += exact.targets->weak();
  if (exact.target_bounces) {
    see((*exact.target_bounces)(scene, ends, *exact.targets));  // target_bounces
    out.weak += exact.target_bounces->weak();
  }
  if (!exact.target_chains) return;
  chain_targets(exact, scene, ends, set, nodes, take).add_to(out);  // candidates, solve, targets, sort, point_join
  tell();
}

}  // namespace

Uncounted solve_paths(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set, Search search,
                      const FrameWatch& watch, FrameAccount& account,
                      const std::function<std::optional<LinkLimits>()>& floor_links) {
  Counters& counters = set.counters();
  uint64_t kinds_done = 0;
  Uncounted out;
  exact.visible.clear();
  const auto take = [&](SolvedList& solved) {
    exact.visible(solved, counters);  // visible
    account.device_done();
  };
  const auto see = [&](SolvedList& solved) {
    exact.check_legs(scene, ends, solved, counters);  // the passes of legs (exact_paths.cpp)
    take(solved);
  };
  constexpr uint64_t steps = 100;  // for each kind
  const auto tell = [&] { watch.tell("paths", steps * ++kinds_done, steps * exact.kinds()); };
  const auto told = [&](uint32_t done, uint32_t all) {
    watch.tell("paths", steps * kinds_done + steps * done / std::max(all, 1u), steps * exact.kinds());
  };
  watch.tell("paths", 0, steps * exact.kinds());

  uint32_t nodes = set.collect(ends.transmitter_count);     // sequences
  if (exact.diffraction) exact.diffraction->wedges(scene);  // wedges
  if (search != Search::none) nodes = enter_neighbours(exact, scene, ends, set, nodes);
  DiscoveryCounts heard;
  if (exact.from_edges && search != Search::none) heard = hear_edges(exact, scene, ends, set, nodes, search);
  const uint32_t candidates = exact.candidates(scene, ends, set.table(), set.nodes(), nodes, counters);  // candidates
  SolvedList& mirrored = exact.solve(scene, ends, set.table(), set.quarters(), exact.candidates.list(), candidates,
                                     counters, exact.blockers ? &*exact.blockers : nullptr);  // solve
  see(mirrored);
  tell();
  set.keep(mirrored);

  if (exact.diffraction) {
    DiffractedPaths& edges = *exact.diffraction;
    edges.limits.reset();
    if (floor_links)
      if (const auto limits = floor_links()) edges.limits.emplace(*limits);  // link_floors
    out = join_edges(exact, scene, ends, set, nodes, see, told);
    if (edges.chains) see((*edges.chains)(scene, edges.wedges.list(), ends, counters));  // wedge_chains
    tell();
  }
  const auto see_scattered = [&](SolvedList& rows) {
    see(rows);
    tell();
    out.candidates += rows.count;
    out.solved += rows.count;
  };
  if (exact.scatter)
    see_scattered((*exact.scatter)(scene, ends, set.table(), set.quarters(), set.nodes(), nodes, counters));  // scatter
  if (exact.scattered) {
    join_tiles(exact, scene, ends, set, nodes, take, told).add_to(out);  // point_prefixes to tile_edges
    tell();
  }
  if (exact.crowns) see_scattered((*exact.crowns)(ends));  // crowns
  if (exact.targets) solve_targets(exact, scene, ends, set, nodes, see_scattered, take, tell, out);
  out.rays = std::move(heard);
  return out;
}

}  // namespace wavetracer
