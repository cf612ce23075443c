// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/scatter.cl.
// All tiles of a surface may serve the same receivers, so the rows are counted before any is written.
#include "passes/scatter.hpp"

#include <algorithm>
#include <bit>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "passes/tile_rows.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

Scatter::Scatter(gpu::Context& context, const TileTable& tiles, uint32_t surface_count, uint32_t max_depth)
    : context_(context),
      tiles_(make_tile_buffers(context, tiles, surface_count)),
      lit_(context),
      scatter_(context),
      local_(context.info().simple_local_size()),
      tiles_work_(tuning_of(context.info()).tiles),
      entries_(context.buffer<uint32_t>(4 * 1024, {"lit surfaces", advice::tiles})),
      first_row_(context.buffer<uint32_t>(1024 + 1, {"rows of tiles", advice::tiles})),
      count_(context.buffer<uint32_t>(1, {"lit surfaces", advice::tiles})) {
  solved_.max_depth = std::max(max_depth, 1u);
  solved_.deepest = 1;
  solved_.reserve(context, 1 << 12);
}

uint32_t Scatter::find_lit(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                           const gpu::Buffer<uint32_t>& nodes, uint32_t node_count, Counters& counters) {
  const uint32_t groups = ends.receiver_capacity / 16;
  const auto capacity = [&] { return static_cast<uint32_t>(entries_.size() / 4); };
  return grow_until_filled(
      [&] {
        context_.fill(count_, 0, Stage::scatter);
        lit_({size_t{node_count} * groups, local_}, Stage::scatter,
             calls::scatter::lit{.table = trie,
                                 .nodes = nodes,
                                 .transmitters = ends.transmitters,
                                 .receivers = ends.receivers,
                                 .links = ends.links,
                                 .surfaces = scene.exact_surfaces,
                                 .tiles_of = tiles_.of_surfaces,
                                 .out = entries_,
                                 .count = count_,
                                 .counters = counters.buffer(),
                                 .args = wt_lit_arguments{node_count, ends.transmitter_count, groups, capacity()}});
      },
      [&] { return count_.read_one(0, Stage::scatter); }, capacity,
      [&](size_t larger) {
        first_row_ = context_.buffer<uint32_t>(larger + 1, {"rows of tiles", advice::tiles});
        entries_ =
            context_.buffer<uint32_t>(4 * larger, {"lit surfaces", advice::tiles});  // says how much room there is
      });
}

std::vector<uint32_t> Scatter::place_rows(uint32_t entry_count) {
  const std::vector<uint32_t> entries = entries_.read(0, 4 * size_t{entry_count}, Stage::scatter);
  std::vector<uint32_t> first_row{0};
  uint64_t rows = 0;
  for (size_t i = 0; i < entries.size(); i += 4) {
    rows += static_cast<uint64_t>(std::popcount(entries[i + 2])) * entries[i + 3];
    first_row.push_back(static_cast<uint32_t>(rows));
  }
  reserve_tile_rows(context_, solved_, rows);
  return first_row;
}

SolvedList& Scatter::operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                                const gpu::Buffer<uint32_t>& quarters, const gpu::Buffer<uint32_t>& nodes,
                                uint32_t node_count, Counters& counters) {
  solved_.count = 0;
  const bool any = node_count > 0 && ends.transmitter_count > 0 && ends.receiver_count > 0;
  const uint32_t entry_count = any ? find_lit(scene, ends, trie, nodes, node_count, counters) : 0;
  if (entry_count == 0) return solved_;
  const std::vector<uint32_t> first_row = place_rows(entry_count);
  first_row_.write(first_row, 0, Stage::scatter);
  solved_.count = first_row.back();
  scatter_(tiles_work_.range(solved_.count), Stage::scatter,
           calls::scatter::scatter{
               .table = trie,
               .quarters = quarters,
               .entries = entries_,
               .first_row = first_row_,
               .surfaces = scene.exact_surfaces,
               .tiles_of = tiles_.of_surfaces,
               .centres = tiles_.centres,
               .instances = scene.exact_instances,
               .solved = solved_.headers,
               .vertices = solved_.vertices,
               .sequences = solved_.sequences,
               .args = wt_scatter_arguments{entry_count, solved_.count, tiles_work_.per_item, solved_.max_depth}});
  return solved_;
}

}  // namespace wavetracer
