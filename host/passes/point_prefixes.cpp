// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/point_prefixes.cl.
// Entries of one node and one end have as many tries as the surface has tiles, so the tries are counted before any is
// made.
#include "passes/point_prefixes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "passes/advice.hpp"
#include "passes/growing_list.hpp"
#include "wavetracer/device/points.h"

namespace wavetracer {
namespace {

constexpr uint32_t least_points = 1 << 12;
constexpr uint64_t bytes_beside_row = 2 * sizeof(uint32_t) + sizeof(wt_point_prefix);

}  // namespace

PointPrefixes::PointPrefixes(gpu::Context& context, uint32_t row_depth, uint32_t reflections)
    : context_(context),
      onlookers_(context),
      kernel_(context),
      keys_(context),
      place_(context),
      nodes_work_(tuning_of(context.info()).prefixes),
      rows_work_(tuning_of(context.info()).points),
      onlooker_lanes_(tuning_of(context.info()).onlooker_lanes),
      local_(context.info().simple_local_size()),
      reflections_(reflections),
      most_(most_rows(context.info(), row_depth, bytes_beside_row, 8, least_points)),
      entries_(context.buffer<uint32_t>(4 * 1024, {"onlookers of tiles", advice::tiles})),
      first_row_(context.buffer<uint32_t>(1024 + 1, {"rows of onlookers", advice::tiles})),
      count_(context.buffer<uint32_t>(1, {"onlookers of tiles", advice::tiles})) {
  list_.rows.max_depth = row_depth;
  list_.rows.deepest = reflections + 1;
  list_.rows.open = 1;
  reserve(least_points);
}

void PointPrefixes::reserve(size_t rows) {
  list_.keys = context_.buffer<uint32_t>(rows, {"keys of tiles", advice::points});
  list_.order = context_.buffer<uint32_t>(rows, {"order of tiles", advice::points});
  list_.sorted = context_.buffer<wt_point_prefix>(rows, {"prefixes of tiles", advice::points});
  list_.rows.reserve(context_, rows);  // its headers say how much room there is
}

uint32_t PointPrefixes::find_onlookers(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                                       const FoundSequences& found, uint32_t first, uint32_t end, Counters& counters) {
  const auto capacity = [&] { return static_cast<uint32_t>(entries_.size() / 4); };
  return grow_until_filled(
      [&] {
        context_.fill(count_, 0, Stage::point_prefixes);
        onlookers_(
            nodes_work_.range(size_t{found.node_count} * onlooker_lanes_), Stage::point_prefixes,
            calls::point_prefixes::onlookers{.table = found.table,
                                             .nodes = found.nodes,
                                             .ends = ends.transmitters,
                                             .first_ends = ends.first_ends,
                                             .surfaces = scene.exact_surfaces,
                                             .boxes = scene.surfaces,
                                             .tiles_of = tiles.of_surfaces,
                                             .blocks = tiles.blocks,
                                             .out = entries_,
                                             .count = count_,
                                             .counters = counters.buffer(),
                                             .args = wt_onlookers_arguments{found.node_count, reflections_, first, end,
                                                                            capacity(), onlooker_lanes_}});
      },
      [&] { return count_.read_one(0, Stage::point_prefixes); }, capacity,
      [&](size_t larger) {
        first_row_ = context_.buffer<uint32_t>(larger + 1, {"rows of onlookers", advice::tiles});
        entries_ = context_.buffer<uint32_t>(4 * larger, {"onlookers of tiles", advice::tiles});
      });
}

uint64_t PointPrefixes::place_rows(uint32_t entry_count) {
  const std::vector<uint32_t> entries = entries_.read(0, 4 * size_t{entry_count}, Stage::point_prefixes);
  std::vector<uint32_t> first_row{0};
  uint64_t rows = 0;
  for (size_t i = 3; i < entries.size(); i += 4) {
    rows += entries[i];
    first_row.push_back(static_cast<uint32_t>(std::min<uint64_t>(rows, UINT32_MAX)));
  }
  first_row_.write(first_row, 0, Stage::point_prefixes);
  return rows;
}

uint32_t PointPrefixes::operator()(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                                   const FoundSequences& found, uint32_t first, uint32_t end, Counters& counters,
                                   const gpu::Buffer<wt_point_floor>* floors) {
  list_.rows.count = 0;
  list_.hidden = wt_point_key(tiles.count, 0);
  const bool any = found.node_count > 0 && ends.transmitter_count > 0 && ends.receiver_count > 0;
  const uint32_t entry_count = any ? find_onlookers(scene, tiles, ends, found, first, end, counters) : 0;
  if (entry_count == 0) return 0;
  const uint64_t tries = place_rows(entry_count);
  if (tries >= UINT32_MAX) return UINT32_MAX;  // too many for one launch
  const auto count = static_cast<uint32_t>(tries);
  const uint32_t rows = grow_until_filled(
      [&] {
        context_.fill(count_, 0, Stage::point_prefixes);
        kernel_(rows_work_.range(count), Stage::point_prefixes,
                calls::point_prefixes::point_prefixes{
                    .table = found.table,
                    .quarters = found.quarters,
                    .ends = ends.transmitters,
                    .receiver_of_end = ends.receiver_of_end,
                    .links = ends.links,
                    .floors = floors,
                    .entries = entries_,
                    .first_row = first_row_,
                    .surfaces = scene.exact_surfaces,
                    .boxes = scene.surfaces,
                    .triangles = scene.exact_triangles,
                    .instances = scene.exact_instances,
                    .tiles_of = tiles.of_surfaces,
                    .centres = tiles.centres,
                    .solved = list_.rows.headers,
                    .vertices = list_.rows.vertices,
                    .sequences = list_.rows.sequences,
                    .count = count_,
                    .args = wt_point_prefixes_arguments{entry_count, count, rows_work_.per_item, list_.rows.max_depth,
                                                        static_cast<uint32_t>(list_.rows.headers.size()),
                                                        ends.transmitter_count, ends.receiver_capacity / 16}});
      },
      [&] { return count_.read_one(0, Stage::point_prefixes); }, [&] { return list_.rows.headers.size(); },
      [&](size_t larger) { reserve(larger); }, most_);
  if (rows <= most_) list_.rows.count = rows;
  return rows;
}

void PointPrefixes::make_keys(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                              PointPrefixList& list) {
  const SolvedList& rows = list.rows;
  if (rows.count == 0) return;
  keys_({rows.count, local_}, Stage::point_prefixes,
        calls::point_prefixes::point_keys{.solved = rows.headers,
                                          .vertices = rows.vertices,
                                          .sequences = rows.sequences,
                                          .ends = ends.transmitters,
                                          .surfaces = scene.exact_surfaces,
                                          .surface_of_tile = tiles.surfaces,
                                          .keys = list.keys,
                                          .count = rows.count,
                                          .max_depth = rows.max_depth,
                                          .hidden = list.hidden});
}

void PointPrefixes::place(const RadioEnds& ends, PointPrefixList& list, const gpu::Buffer<wt_wedge>* wedges,
                          const BentWaves& waves) {
  const SolvedList& rows = list.rows;
  if (rows.count == 0) return;
  place_({rows.count, local_}, Stage::point_prefixes,
         calls::point_prefixes::place_points{.keys = list.keys,
                                             .order = list.order,
                                             .solved = rows.headers,
                                             .vertices = rows.vertices,
                                             .sequences = rows.sequences,
                                             .ends = ends.transmitters,
                                             .wedges = wedges,
                                             .sorted = list.sorted,
                                             .count = rows.count,
                                             .max_depth = rows.max_depth,
                                             .hidden = list.hidden,
                                             .wavelength_m = waves.wavelength_m,
                                             .wave_m = waves.wave_m});
}

void PointPrefixes::refuse(uint32_t prefixes) const {
  throw gpu::BufferError(
      fmt::format("one tile is seen in {} ways by all ends and their mirrors, more than the {} that {} is given at a "
                  "time. {}",
                  prefixes, most_, context_.info().name, advice::points));
}

}  // namespace wavetracer
