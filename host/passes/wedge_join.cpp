// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/wedge_join.cl.
// A prefix has one work-item or a group of them: few prefixes or thousands may see a wedge.
#include "passes/wedge_join.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {
namespace {

constexpr uint32_t least_candidates = 1 << 14;

// The most candidates, at least as many as the list begins with. All of them may be solved, so the memory of solved
// paths counts, too.
uint32_t most_candidates(const gpu::DeviceInfo& device, uint32_t row_depth) {
  const uint64_t path_bytes = sizeof(wt_solved) + (3 * sizeof(double) + sizeof(uint32_t)) * row_depth;
  const uint64_t most = std::min(device.max_buffer / (3 * sizeof(double) * std::max(row_depth, 1u)),
                                 device.global_memory / (4 * (sizeof(wt_wedge_candidate) + path_bytes)));
  return static_cast<uint32_t>(std::clamp<uint64_t>(most, least_candidates, 1u << 30));
}

}  // namespace

WedgeJoin::WedgeJoin(gpu::Context& context, uint32_t max_depth, uint32_t row_depth, double wavelength_m)
    : context_(context),
      kernel_(context),
      max_depth_(max_depth),
      lanes_(tuning_of(context.info()).join_lanes),
      group_(tuning_of(context.info()).join_group),
      most_(most_candidates(context.info(), row_depth)),
      end_detour_m_(static_cast<float>(WT_END_DETOUR * wavelength_m)),
      list_(context.buffer<wt_wedge_candidate>(least_candidates, {"wedge candidates", advice::links})) {}

void WedgeJoin::refuse(uint32_t candidates) const {
  throw gpu::BufferError(
      fmt::format("one sequence of a transmitter makes {} candidates of diffracted paths, more than the {} that {} is "
                  "given at a time. {}",
                  candidates, most_, context_.info().name, advice::links));
}

uint32_t WedgeJoin::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t first, uint32_t end,
                               const WedgeList& wedges, const RadioEnds& ends, Counters& counters, WedgePairs* pairs) {
  const size_t items = size_t{end - first} * lanes_;
  const auto run = [&] {
    const wt_wedge_join_arguments arguments{.count = prefixes.count,
                                            .first = first,
                                            .end = end,
                                            .lanes = lanes_,
                                            .transmitter_count = ends.transmitter_count,
                                            .groups = ends.receiver_capacity / 16,
                                            .max_depth = max_depth_,
                                            .capacity = static_cast<uint32_t>(list_.size()),
                                            .end_detour_m = end_detour_m_};
    kernel_({items, group_}, Stage::wedge_join,
            calls::wedge_join::wedge_join{.keys = prefixes.keys,
                                          .prefixes = prefixes.sorted,
                                          .receiver_of_end = ends.receiver_of_end,
                                          .links = ends.links,
                                          .wedges = wedges.wedges,
                                          .surfaces = scene.surfaces,
                                          .out = list_,
                                          .counters = counters.buffer(),
                                          .args = arguments});
    if (pairs && max_depth_ >= 2) (*pairs)(scene, prefixes, wedges, ends, arguments, list_, counters);
  };
  return fill_list(
      counters, &wt_counters::wedge_candidates, Stage::wedge_join, [&] { return list_.size(); }, run,
      [&](size_t entries) {
        list_ = context_.buffer<wt_wedge_candidate>(entries, {"wedge candidates", advice::links});
      },
      0, most_);
}

}  // namespace wavetracer
