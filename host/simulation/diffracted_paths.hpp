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
#include "passes/growing_list.hpp"
#include "passes/sequences.hpp"
#include "passes/sort.hpp"
#include "passes/wedge_chains.hpp"
#include "passes/wedge_join.hpp"
#include "passes/wedge_pairs.hpp"
#include "passes/wedge_prefixes.hpp"
#include "passes/wedge_solve.hpp"
#include "passes/wedges.hpp"
#include "simulation/frame_account.hpp"

namespace wavetracer {

// Pairs of edges may take longer than a frame of a drive. So they are made from this many prefixes at a time, and a
// frame can be cancelled in between and report its progress.
constexpr uint32_t prefix_block = 4096, most_at_once = 1 << 15;

struct DiffractedPaths {
  // wavelength_m: see WedgeSolve. two: for paths over two wedges. row_depth: interactions that a solved path has room
  // for, at least max_depth.
  DiffractedPaths(gpu::Context& context, Wedges world, uint32_t max_depth, uint32_t row_depth, double wavelength_m,
                  std::optional<WedgePairs> two)
      : wedges(std::move(world)),
        prefixes(context),
        join(context, max_depth, row_depth, wavelength_m),
        pairs(std::move(two)),
        solve(context, row_depth, wavelength_m),
        sort_(context) {
    // With this, tests need no scene of millions of candidates.
    if (const std::string most = environment("WAVETRACER_MOST_CANDIDATES"); !most.empty())
      join.set_most(static_cast<uint32_t>(std::max(std::atol(most.c_str()), 1L)));
  }

  WedgePairs* for_two() { return pairs ? &*pairs : nullptr; }

  // Puts prefixes in the order of the wedges that they see.
  void sort(WedgePrefixList& list) {
    if (list.count > 0) sort_(list.keys, list.order, list.count, wedges.key_bits());
    prefixes.place(list);
    if (pairs) pairs->list_runs(wedges.list(), list);
  }

  Wedges wedges;
  WedgePrefixes prefixes;
  WedgeJoin join;
  std::optional<WedgePairs> pairs;
  WedgeSolve solve;
  std::optional<WedgeChains> chains;  // given with two edges and more

 private:
  Sort sort_;
};

// Runs wedge_join to visible. The prefixes are divided into parts where all have too many candidates for one list, or
// take long. see: runs the passes after wedge_solve; told(done): is called before another part, with the number of
// prefixes that are done. Returns the counts that the counters lack: those of all parts except the last.
template <class See, class Told>
Uncounted join_prefixes(DiffractedPaths& edges, const DeviceScene& scene, const RadioEnds& ends, Sequences& set,
                        const WedgePrefixList& prefixes, const See& see, const Told& told) {
  Counters& counters = set.counters();
  Uncounted out, part;
  const bool at_once = counters.foresees() || !edges.pairs || prefixes.count <= most_at_once || !edges.join.waits();
  by_parts(
      prefixes.count, at_once ? prefixes.count : prefix_block, counters.foresees() ? 0xFFFFFFFFu : edges.join.most(),
      [&](uint32_t first, uint32_t end) {
        return edges.join(scene, prefixes, first, end, edges.wedges.list(), ends, counters,
                          edges.for_two());  // wedge_join, wedge_pairs
      },
      [&](uint32_t joined) {
        SolvedList& solved = edges.solve(scene, edges.wedges.list(), ends, set.table(), edges.join.list(), joined,
                                         counters);  // wedge_solve
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
      [&](uint32_t candidates) { edges.join.refuse(candidates); });
  return out;
}

}  // namespace wavetracer
