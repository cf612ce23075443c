// SPDX-License-Identifier: Apache-2.0
// Host side of the kernels targets and target_bodies of kernels/paths/targets.cl.
#include "passes/targets.hpp"

#include <algorithm>
#include <string>

#include "passes/advice.hpp"
#include "passes/tile_rows.hpp"
#include "radio/world_records.hpp"
#include "wavetracer/device/points.h"

namespace wavetracer {

TargetRows::TargetRows(gpu::Context& context, uint32_t points, uint32_t max_depth)
    : context_(context),
      kernel_(context),
      work_(tuning_of(context.info()).tiles),
      count_(points),
      points_(context.buffer<wt_target_point>(points, {"points of targets", advice::targets})) {
  solved_.max_depth = std::max(max_depth, 1u);
  solved_.deepest = 1;
}

void TargetRows::place(const WorldState& world) { points_.write(target_records(world), 0, Stage::targets); }

SolvedList& TargetRows::operator()(const DeviceScene& scene, const RadioEnds& ends) {
  links_.update(context_, ends, "links of targets");
  solved_.count = reserve_point_rows(context_, solved_, uint64_t{links_.count()} * count_,
                                     "targets have {} paths to test", std::string(". ") + advice::targets);
  if (solved_.count > 0)
    kernel_(work_.range(solved_.count), Stage::targets,
            calls::targets::targets{.links = links_.pairs(),
                                    .points = points_,
                                    .transmitters = ends.transmitters,
                                    .receivers = ends.receivers,
                                    .surfaces = scene.exact_surfaces,
                                    .solved = solved_.headers,
                                    .vertices = solved_.vertices,
                                    .sequences = solved_.sequences,
                                    .args = wt_targets_arguments{.row_count = solved_.count,
                                                                 .rows_per_item = work_.per_item,
                                                                 .points = count_,
                                                                 .max_depth = solved_.max_depth}});
  return solved_;
}

TargetBodies::TargetBodies(gpu::Context& context, const std::vector<uint32_t>& is_body)
    : kernel_(context),
      group_(tuning_of(context.info()).exact.group),
      is_body_(context.buffer(is_body, "bodies that are targets")) {}

void TargetBodies::operator()(const DeviceScene& scene, SolvedList& solved, Counters& counters,
                              const StepTables& steps) {
  if (solved.count == 0) return;
  kernel_({solved.count, group_}, Stage::targets,
          calls::targets::target_bodies{.surfaces = scene.exact_surfaces,
                                        .wedges = steps.wedges,
                                        .surface_of_tile = steps.surface_of_tile,
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
