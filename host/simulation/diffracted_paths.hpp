// The passes of diffracted paths: what prefixes of both ends see is sorted by wedge, joined there, and solved.
// No ray need hit an edge: a ray that meets a face says that its prefix sees the wedges of that face. Assumes that both
// ends of every link have launched, and that place has run.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/sort.hpp"
#include "passes/wedge_join.hpp"
#include "passes/wedge_prefixes.hpp"
#include "passes/wedge_solve.hpp"
#include "passes/wedges.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

struct DiffractedPaths {
  // world: its wedges; receiver_of_origin: see WedgeJoin.
  DiffractedPaths(gpu::Context& context, Wedges world, const std::vector<uint32_t>& receiver_of_origin,
                  const TraceConfig& trace)
      : wedges(std::move(world)),
        prefixes(context),
        join(context, receiver_of_origin, trace.max_depth, trace.max_diffractions > 1),
        solve(context, trace.max_depth),
        sort_(context) {}

  // Sorts prefixes by the wedges that they see.
  void sort(WedgePrefixList& list) {
    if (list.count > 0) sort_(list.keys, list.order, list.count, wedges.key_bits());
  }

  Wedges wedges;
  WedgePrefixes prefixes;
  WedgeJoin join;
  WedgeSolve solve;

 private:
  Sort sort_;
};

}  // namespace wavetracer
