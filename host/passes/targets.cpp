// SPDX-License-Identifier: Apache-2.0
// Host side of the kernels targets and target_bodies of kernels/paths/targets.cl.
#include "passes/targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "passes/tile_rows.hpp"
#include "radio/world_records.hpp"
#include "wavetracer/device/points.h"
#include "wavetracer/error.hpp"

namespace wavetracer {

TargetRows::TargetRows(gpu::Context& context, uint32_t points, uint32_t max_depth, const TargetLimits& limits)
    : context_(context),
      kernel_(context),
      work_(tuning_of(context.info()).tiles),
      count_(points),
      floor_(limits.floor),
      leaves_out_(limits.floor > 0 || limits.sides),
      points_(context.buffer<wt_target_point>(points, {"points of targets", advice::targets})) {
  if (floor_ > 0) powers_ = context.buffer(limits.powers, {"powers of targets", advice::targets});
  if (leaves_out_) counts_ = context.buffer<uint32_t>(3, "counts of paths over targets");
  solved_.max_depth = std::max(max_depth, 1u);
  solved_.deepest = 1;
}

void TargetRows::place(const WorldState& world) { points_.write(target_records(world), 0, Stage::targets); }

void TargetRows::launch(const DeviceScene& scene, const RadioEnds& ends, uint32_t rows,
                        const gpu::Buffer<uint32_t>* counts) {
  kernel_(
      work_.range(rows), Stage::targets,
      calls::targets::targets{.links = links_.pairs(),
                              .points = points_,
                              .powers = powers(),
                              .transmitters = ends.transmitters,
                              .receivers = ends.receivers,
                              .surfaces = scene.exact_surfaces,
                              .solved = solved_.headers,
                              .vertices = solved_.vertices,
                              .sequences = solved_.sequences,
                              .counts = counts,
                              .args = wt_targets_arguments{.floor = floor_,
                                                           .row_count = rows,
                                                           .rows_per_item = work_.per_item,
                                                           .points = count_,
                                                           .max_depth = solved_.max_depth,
                                                           .capacity = static_cast<uint32_t>(solved_.headers.size()),
                                                           .padding = 0}});
}

uint32_t TargetRows::write_seen(const DeviceScene& scene, const RadioEnds& ends, uint64_t rows) {
  constexpr const char* too_many = "targets have {} paths to choose from";
  constexpr uint64_t least_rows = 1 << 12;
  if (rows > 0xFFFFFFFFu)
    throw RuntimeError(fmt::format(fmt::runtime(too_many), rows) + fmt::format(" in this frame. {}", advice::targets));
  reserve_point_rows(context_, solved_, std::min(rows, least_rows), too_many, std::string(". ") + advice::targets);
  std::vector<uint32_t> counts;
  const uint32_t seen = grow_until_filled(
      [&] {
        context_.fill(counts_, 0, Stage::targets);
        launch(scene, ends, static_cast<uint32_t>(rows), &counts_);
      },
      [&] {
        counts = counts_.read(0, 3, Stage::targets);
        return counts[0];
      },
      [&] { return solved_.headers.size(); },
      [&](size_t more) {
        reserve_point_rows(context_, solved_, more, "targets have {} paths to test",
                           std::string(". ") + advice::targets);
      });
  weak_ = uint64_t{counts[2]} << 32 | counts[1];
  return seen;
}

SolvedList& TargetRows::operator()(const DeviceScene& scene, const RadioEnds& ends) {
  links_.update(context_, ends, "links of targets");
  const uint64_t rows = uint64_t{links_.count()} * count_;
  weak_ = 0;
  solved_.count = 0;
  if (rows == 0) return solved_;
  if (leaves_out_) {
    solved_.count = write_seen(scene, ends, rows);
    return solved_;
  }
  solved_.count =
      reserve_point_rows(context_, solved_, rows, "targets have {} paths to test", std::string(". ") + advice::targets);
  launch(scene, ends, solved_.count, nullptr);
  return solved_;
}

TargetBodies::TargetBodies(gpu::Context& context, const std::vector<uint32_t>& is_body)
    : kernel_(context),
      group_(tuning_of(context.info()).exact.group),
      is_body_(context.buffer(is_body, "bodies that are targets")) {}

void TargetBodies::operator()(const DeviceScene& scene, SolvedList& solved, Counters& counters, const StepTables& steps,
                              const TargetRows& targets) {
  if (solved.count == 0) return;
  kernel_({solved.count, group_}, Stage::targets,
          calls::targets::target_bodies{.surfaces = scene.exact_surfaces,
                                        .wedges = steps.wedges,
                                        .surface_of_tile = steps.surface_of_tile,
                                        .points = targets.points(),
                                        .is_body = is_body_,
                                        .solved = solved.headers,
                                        .sequences = solved.sequences,
                                        .counters = counters.buffer(),
                                        .count = solved.count,
                                        .solved_counter = solved.counter,
                                        .max_depth = solved.max_depth,
                                        .tile_count = steps.tile_count()});
}

}  // namespace wavetracer
