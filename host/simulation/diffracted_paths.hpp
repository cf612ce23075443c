// The passes of diffracted paths: what prefixes of both ends see is sorted by wedge, joined there, and solved.
// No ray need hit an edge: a ray that meets a face says that its prefix sees the wedges of that face. Assumes that both
// ends of every link have launched, and that place has run.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "passes/sort.hpp"
#include "passes/wedge_join.hpp"
#include "passes/wedge_pairs.hpp"
#include "passes/wedge_prefixes.hpp"
#include "passes/wedge_solve.hpp"
#include "passes/wedges.hpp"

namespace wavetracer {

struct DiffractedPaths {
  // receiver_of_origin: see WedgeJoin. two: for paths over two wedges.
  DiffractedPaths(gpu::Context& context, Wedges world, const std::vector<uint32_t>& receiver_of_origin,
                  uint32_t max_depth, std::optional<WedgePairs> two)
      : wedges(std::move(world)),
        prefixes(context),
        join(context, receiver_of_origin, max_depth),
        pairs(std::move(two)),
        solve(context, max_depth),
        sort_(context) {}

  WedgePairs* for_two() { return pairs ? &*pairs : nullptr; }

  // Sorts prefixes by the wedges that they see.
  void sort(WedgePrefixList& list) {
    if (list.count > 0) sort_(list.keys, list.order, list.count, wedges.key_bits());
  }

  Wedges wedges;
  WedgePrefixes prefixes;
  WedgeJoin join;
  std::optional<WedgePairs> pairs;
  WedgeSolve solve;

 private:
  Sort sort_;
};

}  // namespace wavetracer
