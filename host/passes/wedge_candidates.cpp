// SPDX-License-Identifier: Apache-2.0
// All candidates may be solved, so the memory of solved paths limits their number, too.
#include "passes/wedge_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "passes/advice.hpp"
#include "passes/solved_list.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t least_candidates = 1 << 14;

// The most candidates, at least as many as the list begins with.
uint32_t most_candidates(const gpu::DeviceInfo& device, uint32_t row_depth) {
  const uint64_t most = std::min(device.max_buffer / (3 * sizeof(double) * std::max(row_depth, 1u)),
                                 device.global_memory / (4 * (sizeof(wt_wedge_candidate) + bytes_of_row(row_depth))));
  return static_cast<uint32_t>(std::clamp<uint64_t>(most, least_candidates, 1u << 30));
}

}  // namespace

WedgeCandidates::WedgeCandidates(gpu::Context& context, uint32_t row_depth)
    : context_(context), most_(most_candidates(context.info(), row_depth)) {
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
