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
        context_(context),
        sort_(context) {}

  // Sorts prefixes by the wedges that they see.
  void sort(WedgePrefixList& list) {
    const size_t words = sort_.temporary_words(list.count);
    if (temporary_.size() < words) temporary_ = context_.buffer<uint32_t>(words + words / 4, "sort");
    if (list.count > 0) sort_(list.keys, list.order, list.count, temporary_, wedges.key_bits());
  }

  Wedges wedges;
  WedgePrefixes prefixes;
  WedgeJoin join;
  WedgeSolve solve;

 private:
  gpu::Context& context_;
  Sort sort_;
  gpu::Buffer<uint32_t> temporary_;
};

}  // namespace wavetracer
