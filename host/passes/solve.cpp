// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/solve.cl.
// One candidate per work-item, or a run of them on CPUs, whose rows are near each other then.
#include "passes/solve.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "passes/growing_list.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {
namespace {

// CPUs: candidates of a work-item, and the largest depth whose points it keeps until it knows their places.
constexpr uint32_t together = 16, deepest_together = 8;

uint32_t candidates_of_item(const gpu::DeviceInfo& device, uint32_t max_depth) {
  return device.cpu && max_depth <= deepest_together ? together : 1;
}

gpu::Definitions build_of(const gpu::DeviceInfo& device, uint32_t max_depth, bool remembers) {
  gpu::Definitions out;
  if (remembers) out["WT_BLOCKERS"] = "1";
  if (const uint32_t candidates = candidates_of_item(device, max_depth); candidates > 1) {
    out["WT_TOGETHER"] = std::to_string(candidates) + "u";
    out["WT_ROOM"] = std::to_string(max_depth) + "u";
  }
  return out;
}

}  // namespace

Solve::Solve(gpu::Context& context, uint32_t max_depth, bool remembers)
    : context_(context),
      work_(tuning_of(context.info()).exact),
      remembers_(remembers),
      kernel_(context, build_of(context.info(), std::max(max_depth, 1u), remembers)) {
  work_.per_item = candidates_of_item(context.info(), std::max(max_depth, 1u));
  if (work_.per_item > 1) work_.group = 1;
  solved_.max_depth = std::max(max_depth, 1u);
  solved_.counter = counter_word(&wt_counters::solved);
  solved_.reserve(context, 1 << 14);
}

SolvedList& Solve::operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                              const gpu::Buffer<uint32_t>& quarters, const gpu::Buffer<wt_candidate>& candidates,
                              uint32_t candidate_count, Counters& counters, const Blockers* blockers) {
  if (remembers_ && !blockers) throw std::logic_error("solve: there is no table of what hid paths");
  const auto run = [&] {
    calls::solve::solve call{.table = trie,
                             .quarters = quarters,
                             .transmitters = ends.transmitters,
                             .receivers = ends.receivers,
                             .surfaces = scene.exact_surfaces,
                             .triangles = scene.exact_triangles,
                             .instances = scene.exact_instances,
                             .candidates = candidates,
                             .solved = solved_.headers,
                             .vertices = solved_.vertices,
                             .sequences = solved_.sequences,
                             .counters = counters.buffer(),
                             .args = wt_solve_arguments{.candidate_count = candidate_count,
                                                        .max_depth = solved_.max_depth,
                                                        .capacity = static_cast<uint32_t>(solved_.headers.size()),
                                                        .triangle_slots = scene.triangle_slots,
                                                        .blocker_mask = Blockers::mask,
                                                        .wavelength_m = 0,
                                                        .floors = {},
                                                        .second = 0,
                                                        .left_out_unit = 0,
                                                        .receiver_count = 0}};
    if (remembers_) {
      call.leaves = scene.leg_leaves();
      call.blockers = blockers->places;
    }
    kernel_(work_.range(candidate_count), Stage::solve, call);
  };
  solved_.count = fill_list(
      counters, &wt_counters::solved, Stage::solve, [&] { return solved_.headers.size(); }, run,
      [&](size_t rows) {
        solved_.reserve(context_, rows);
        counters.restart(&wt_counters::hidden, 0, Stage::solve);
      });
  return solved_;
}

}  // namespace wavetracer
