// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/target_bounces.cl.
// Rows are launched in blocks, since a body has many chains and a frame many links.
#include "passes/target_bounces.hpp"

#include <algorithm>
#include <string>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "passes/tile_rows.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t block_of_rows = uint64_t{1} << 28;
constexpr uint64_t least_bounced = 1 << 12;  // rows

}  // namespace

TargetBounces::TargetBounces(gpu::Context& context, const std::vector<wt_target_bounce>& bounces, uint32_t max_depth)
    : context_(context),
      kernel_(context),
      work_(tuning_of(context.info()).points),
      bounces_(context.buffer(bounces, {"bounces within bodies", advice::bounces})),
      counts_(context.buffer<uint32_t>(3, "counts of bounces within bodies")) {
  solved_.max_depth = max_depth;
  for (const wt_target_bounce& bounce : bounces) solved_.deepest = std::max(solved_.deepest, bounce.count + 1);
}

void TargetBounces::launch(const DeviceScene& scene, const RadioEnds& ends, const TargetRows& targets) {
  const uint64_t rows = uint64_t{links_.count()} * bounces_.size() * 2;
  for (uint64_t first = 0; first < rows; first += block_of_rows) {
    const uint64_t end = std::min(rows, first + block_of_rows);
    kernel_(work_.range(static_cast<uint32_t>(end - first)), Stage::targets,
            calls::target_bounces::target_bounces{
                .links = links_.pairs(),
                .bounces = bounces_,
                .points = targets.points(),
                .powers = targets.powers(),
                .transmitters = ends.transmitters,
                .receivers = ends.receivers,
                .surfaces = scene.exact_surfaces,
                .triangles = scene.exact_triangles,
                .instances = scene.exact_instances,
                .solved = solved_.headers,
                .vertices = solved_.vertices,
                .sequences = solved_.sequences,
                .counts = counts_,
                .args = wt_target_bounces_arguments{.floor = targets.floor(),
                                                    .first_row = first,
                                                    .end_row = end,
                                                    .bounces = static_cast<uint32_t>(bounces_.size()),
                                                    .rows_per_item = work_.per_item,
                                                    .max_depth = solved_.max_depth,
                                                    .capacity = static_cast<uint32_t>(solved_.headers.size())}});
  }
}

SolvedList& TargetBounces::operator()(const DeviceScene& scene, const RadioEnds& ends, const TargetRows& targets) {
  links_.update(context_, ends, "links of bodies");
  weak_ = 0;
  solved_.count = 0;
  if (links_.count() == 0) return solved_;
  const auto reserve = [&](uint64_t rows) {
    reserve_point_rows(context_, solved_, rows, "bounces within bodies have {} paths to test",
                       std::string(". ") + advice::bounces);
  };
  reserve(least_bounced);
  std::vector<uint32_t> counts;
  solved_.count = grow_until_filled(
      [&] {
        context_.fill(counts_, 0, Stage::targets);
        launch(scene, ends, targets);
      },
      [&] {
        counts = counts_.read(0, 3, Stage::targets);
        return counts[0];
      },
      [&] { return solved_.headers.size(); }, reserve);
  weak_ = uint64_t{counts[2]} << 32 | counts[1];
  return solved_;
}

}  // namespace wavetracer
