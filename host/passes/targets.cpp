// SPDX-License-Identifier: Apache-2.0
// Host side of the kernel targets of kernels/paths/targets.cl.
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

SolvedList& TargetRows::operator()(const RadioEnds& ends) {
  links_.update(context_, ends, "links of targets");
  solved_.count = reserve_point_rows(context_, solved_, uint64_t{links_.count()} * count_,
                                     "targets have {} paths to test", std::string(". ") + advice::targets);
  if (solved_.count > 0)
    kernel_(work_.range(solved_.count), Stage::targets,
            calls::targets::targets{.links = links_.pairs(),
                                    .points = points_,
                                    .transmitters = ends.transmitters,
                                    .receivers = ends.receivers,
                                    .solved = solved_.headers,
                                    .vertices = solved_.vertices,
                                    .sequences = solved_.sequences,
                                    .args = wt_targets_arguments{.row_count = solved_.count,
                                                                 .rows_per_item = work_.per_item,
                                                                 .points = count_,
                                                                 .max_depth = solved_.max_depth}});
  return solved_;
}

}  // namespace wavetracer
