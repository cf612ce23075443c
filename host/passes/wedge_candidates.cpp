// SPDX-License-Identifier: Apache-2.0
// All candidates may be solved, so the memory of solved paths limits their number, too.
#include "passes/wedge_candidates.hpp"

#include <fmt/format.h>

#include "passes/advice.hpp"
#include "passes/solved_list.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t least_candidates = 1 << 14;

}  // namespace

WedgeCandidates::WedgeCandidates(gpu::Context& context, uint32_t row_depth)
    : context_(context), most_(most_rows(context.info(), row_depth, sizeof(wt_wedge_candidate), 4, least_candidates)) {
  make_room(least_candidates);
}

void WedgeCandidates::make_room(size_t entries) {
  list_ = context_.buffer<wt_wedge_candidate>(entries, {"wedge candidates", advice::links});
}

void WedgeCandidates::refuse(uint32_t candidates) const {
  throw gpu::BufferError(
      fmt::format("one sequence of a transmitter makes {} candidates of diffracted paths, more than the {} that {} is "
                  "given at a time. {}",
                  candidates, most_, context_.info().name, advice::links));
}

}  // namespace wavetracer
