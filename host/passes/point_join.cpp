// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/point_join.cl.
// A prefix has one work-item or a group of them: few prefixes or thousands may see a tile.
#include "passes/point_join.hpp"

#include <fmt/format.h>

#include <utility>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/points.h"

namespace wavetracer {
namespace {

constexpr uint32_t least_joined = 1 << 12;

}  // namespace

PointJoin::PointJoin(gpu::Context& context, JoinedPoints limits)
    : context_(context),
      kernel_(context),
      limits_(std::move(limits)),
      lanes_(tuning_of(context.info()).join_lanes),
      group_(tuning_of(context.info()).join_group),
      most_(most_rows(context.info(), limits_.row_depth, 0, 4, least_joined)),
      counts_(context.buffer<uint32_t>(3, "counts of paths over tiles")) {
  list_.max_depth = limits_.row_depth;
  list_.deepest = limits_.max_depth;
  list_.reserve(context, least_joined);
  if (limits_.floor > 0) powers_ = context.buffer(limits_.powers, {"powers of tiles", advice::tiles});
}

uint32_t PointJoin::operator()(const PointPrefixList& prefixes, uint32_t first, uint32_t end, const RadioEnds& ends) {
  list_.count = 0;
  weak_ = 0;
  const size_t items = size_t{end - first} * lanes_;
  if (items == 0) return 0;
  std::vector<uint32_t> counts;
  const uint32_t paths = grow_until_filled(
      [&] {
        context_.fill(counts_, 0, Stage::point_join);
        kernel_({items, group_}, Stage::point_join,
                calls::point_join::point_join{
                    .keys = prefixes.keys,
                    .prefixes = prefixes.sorted,
                    .vertices = prefixes.rows.vertices,
                    .steps = prefixes.rows.sequences,
                    .receiver_of_end = ends.receiver_of_end,
                    .links = ends.links,
                    .powers = limits_.floor > 0 ? &powers_ : nullptr,
                    .solved = list_.headers,
                    .out_vertices = list_.vertices,
                    .out_steps = list_.sequences,
                    .counts = counts_,
                    .args = wt_point_join_arguments{.floor = limits_.floor,
                                                    .count = prefixes.rows.count,
                                                    .first = first,
                                                    .end = end,
                                                    .lanes = lanes_,
                                                    .hidden = prefixes.hidden,
                                                    .transmitter_count = ends.transmitter_count,
                                                    .groups = ends.receiver_capacity / 16,
                                                    .max_depth = limits_.max_depth,
                                                    .transmissions = limits_.transmissions,
                                                    .row_depth = limits_.row_depth,
                                                    .capacity = static_cast<uint32_t>(list_.headers.size()),
                                                    .diffractions = limits_.diffractions,
                                                    .bends = limits_.bends,
                                                    .padding = 0}});
      },
      [&] {
        counts = counts_.read(0, 3, Stage::point_join);
        return counts[0];
      },
      [&] { return list_.headers.size(); }, [&](size_t rows) { list_.reserve(context_, rows); }, most_);
  if (paths <= most_) {
    list_.count = paths;
    weak_ = uint64_t{counts[2]} << 32 | counts[1];
  }
  return paths;
}

void PointJoin::refuse(uint32_t paths) const {
  throw gpu::BufferError(
      fmt::format("one sequence of a transmitter makes {} paths over a tile, more than the {} that {} is given at a "
                  "time. {}",
                  paths, most_, context_.info().name, advice::points));
}

}  // namespace wavetracer
