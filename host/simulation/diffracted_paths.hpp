// The passes of diffracted paths: what prefixes of both ends see is sorted by wedge, joined there, and solved.
// No ray need hit an edge: a ray that meets a face says that its prefix sees the wedges of that face. Assumes that both
// ends of every link have launched, and that place has run.
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

// Pairs of edges that take longer than a frame of a drive are made of so many prefixes at a time, so that a frame can
// be given up in between, and says how far it has come.
constexpr uint32_t prefix_block = 4096, most_at_once = 1 << 15;

struct DiffractedPaths {
  // receiver_of_origin: see WedgeJoin; wavelength_m: see WedgeSolve. two: for paths over two wedges. row_depth:
  // interactions that a solved path has room for, max_depth or more.
  DiffractedPaths(gpu::Context& context, Wedges world, const std::vector<uint32_t>& receiver_of_origin,
                  uint32_t max_depth, uint32_t row_depth, double wavelength_m, std::optional<WedgePairs> two)
      : wedges(std::move(world)),
        prefixes(context),
        join(context, receiver_of_origin, max_depth, row_depth),
        pairs(std::move(two)),
        solve(context, row_depth, wavelength_m),
        sort_(context) {
    // So that tests need no scene of millions of candidates.
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
  std::optional<WedgeChains> chains;  // with two edges and more

 private:
  Sort sort_;
};

// From wedge_join to visible, with a part of the prefixes after the other where all have too many candidates for one
// list, or take long. see: what follows wedge_solve; told(done): before another part, with how many of the prefixes are
// done. Returns what the counters have not: all parts but the last.
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
