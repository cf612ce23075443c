// SPDX-License-Identifier: Apache-2.0
// The passes of diffracted paths: prefixes of both ends are sorted by the wedges that they see, joined there, and
// solved. No ray need hit an edge: a ray that meets a face says that its prefix sees the wedges of that face. Both ends
// of every link must have launched, and place must have run.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/environment.hpp"
#include "passes/grazed_faces.hpp"
#include "passes/growing_list.hpp"
#include "passes/heard_join.hpp"
#include "passes/link_limits.hpp"
#include "passes/sequences.hpp"
#include "passes/sort.hpp"
#include "passes/wedge_candidates.hpp"
#include "passes/wedge_chains.hpp"
#include "passes/wedge_join.hpp"
#include "passes/wedge_pairs.hpp"
#include "passes/wedge_prefixes.hpp"
#include "passes/wedge_sight.hpp"
#include "passes/wedge_solve.hpp"
#include "passes/wedges.hpp"
#include "simulation/frame_account.hpp"

namespace wavetracer {

// Pairs of edges may take longer than a frame of a drive. So they are made from this many prefixes at a time, and a
// frame can be cancelled in between and report its progress.
constexpr uint32_t prefix_block = 4096, most_at_once = 1 << 15;
// On CPUs listeners' nodes are joined in so many parts, each of so many nodes at least: the lists of a part stay in the
// processor's caches, and only that of the first part is too short and made again.
constexpr uint32_t heard_parts = 64, heard_block = 1024;

// The passes of edges whose rays listeners hear.
struct HeardEdges {
  WedgeSight sight;       // tests the prefixes of transmitters
  HeardJoin join;         // in place of wedge_join
  uint32_t in_sight = 0;  // the prefixes of transmitters that see something of their edges, in the list of prefixes
};

struct DiffractedPaths {
  // wavelength_m: see WedgeSolve. two: for paths over two wedges. row_depth: interactions that a solved path has room
  // for, at least max_depth. ages: see GrazedFaces.
  DiffractedPaths(gpu::Context& context, Wedges world, uint32_t max_depth, uint32_t row_depth, double wavelength_m,
                  BendFloors floors, std::optional<WedgePairs> two, bool ages)
      : wedges(std::move(world)),
        grazed_faces(context, ages),
        prefixes(context),
        join(context, max_depth, wavelength_m),
        candidates(context, row_depth),
        pairs(std::move(two)),
        solve(context, row_depth, wavelength_m, floors),
        waits_(context.info().cpu),
        sort_(context) {
    // With this, tests need no scene of millions of candidates.
    if (const std::string most = environment("WAVETRACER_MOST_CANDIDATES"); !most.empty())
      candidates.set_most(static_cast<uint32_t>(std::max(std::atol(most.c_str()), 1L)));
  }

  WedgePairs* for_two() { return pairs ? &*pairs : nullptr; }

  // Puts prefixes in the order of the wedges that they see.
  void sort(WedgePrefixList& list) {
    if (list.count > 0) sort_(list.keys, list.order, list.count, wedges.key_bits());
    prefixes.place(list);
    if (pairs) pairs->list_runs(wedges.list(), list);
  }

  Wedges wedges;
  GrazedFaces grazed_faces;
  WedgePrefixes prefixes;
  WedgeJoin join;
  WedgeCandidates candidates;
  std::optional<WedgePairs> pairs;
  WedgeSolve solve;
  std::optional<WedgeChains> chains;  // given with two edges and more
  std::optional<HeardEdges> heard;    // with trace.edge_rays
  std::optional<LinkLimits> limits;   // those of the frame, with trace.diffraction_range_db

  // Does waiting for the device cost little? On CPUs it does, and there long passes run in blocks.
  bool waits() const { return waits_; }

 private:
  bool waits_;
  Sort sort_;
};

// Runs a join to visible. Its items, prefixes or nodes, are divided into parts where all have too many candidates for
// one list, or take long: at most `block` of them are joined at once. list(first, end): joins these. see: runs the
// passes after wedge_solve; told(done): is called before another part, with the number of items that are done. Returns
// the counts that the counters lack: those of all parts except the last.
template <class List, class See, class Told>
Uncounted join_by_parts(DiffractedPaths& edges, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                        uint32_t items, uint32_t block, const List& list, const See& see, const Told& told) {
  Counters& counters = set.counters();
  Uncounted out, part;
  by_parts(
      items, block, counters.foresees() ? 0xFFFFFFFFu : edges.candidates.most(), list,
      [&](uint32_t joined) {
        SolvedList& solved = edges.solve(scene, edges.wedges.list(), ends, set.table(), edges.candidates.list(), joined,
                                         counters, edges.limits ? &*edges.limits : nullptr);  // wedge_solve
        see(solved);
        part = {joined, solved.count};
      },
      [&](uint32_t done) {
        out.candidates += std::exchange(part.candidates, 0);
        out.solved += std::exchange(part.solved, 0);
        counters.restart(&wt_counters::wedge_candidates, 0, Stage::wedge_join);
        counters.restart(&wt_counters::wedge_solved, 0, Stage::wedge_solve);
        counters.in_parts();
        told(done);
      },
      [&](uint32_t candidates) { edges.candidates.refuse(candidates); });
  return out;
}

// The same for wedge_join and wedge_pairs.
template <class See, class Told>
Uncounted join_prefixes(DiffractedPaths& edges, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                        const WedgePrefixList& prefixes, const See& see, const Told& told) {
  Counters& counters = set.counters();
  const bool at_once = counters.foresees() || !edges.pairs || prefixes.count <= most_at_once || !edges.waits();
  return join_by_parts(
      edges, scene, ends, set, prefixes.count, at_once ? prefixes.count : prefix_block,
      [&](uint32_t first, uint32_t end) {
        return edges.join(scene, prefixes, first, end, edges.wedges.list(), ends, edges.for_two(), edges.candidates,
                          counters);  // wedge_join, wedge_pairs
      },
      see, told);
}

// The same for heard_join. nodes: the number of all nodes.
template <class See, class Told>
Uncounted join_heard(DiffractedPaths& edges, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                     uint32_t nodes, const See& see, const Told& told) {
  HeardEdges& heard = *edges.heard;
  return join_by_parts(
      edges, scene, ends, set, nodes, edges.waits() ? std::max(nodes / heard_parts, heard_block) : nodes,
      [&](uint32_t first, uint32_t end) {
        return heard.join(scene, edges.prefixes.list(), heard.in_sight,
                          {set.table(), set.quarters(), set.nodes(), first, end}, edges.wedges.list(), ends,
                          edges.candidates, set.counters());  // heard_join
      },
      see, told);
}

}  // namespace wavetracer
