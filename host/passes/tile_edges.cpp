// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/edges/tile_edges.cl.
// Static tiles follow each other along a Z-order curve, so the tiles of a ball are near each other; those of each
// vehicle follow. A prefix has one work-item or a group of them, which share the balls.
#include "passes/tile_edges.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <utility>

#include "passes/advice.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/curves.h"

namespace wavetracer {
namespace {

constexpr uint32_t axis_bits = 20;  // bits of an axis of the curve

void fill_last_ball(std::vector<uint32_t>& order) {
  while (order.size() % WT_TILE_BALL != 0) order.push_back(WT_NONE);
}

// The numbers of all tiles in their order; WT_NONE fills the last ball of the scene and of each vehicle.
std::vector<uint32_t> order_of_tiles(const TileTable& tiles) {
  const std::vector<Tile>& scene = tiles.tiles(0);
  glm::dvec3 low(0), high(0);
  if (!scene.empty()) low = high = scene[0].centre_m;
  for (const Tile& tile : scene) {
    low = glm::min(low, tile.centre_m);
    high = glm::max(high, tile.centre_m);
  }
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-3});
  std::vector<std::pair<uint64_t, uint32_t>> keys;
  for (uint32_t i = 0; i < scene.size(); ++i) {
    const glm::dvec3 at = (scene[i].centre_m - low) / extent * static_cast<double>((1u << axis_bits) - 1);
    const glm::uvec3 cell(at);
    keys.emplace_back(device::wt_morton3_encode(cell.x, cell.y, cell.z), i);
  }
  std::ranges::sort(keys);
  std::vector<uint32_t> out;
  for (const auto& [key, tile] : keys) out.push_back(tile);
  fill_last_ball(out);
  for (uint32_t i = 0; i < tiles.instances().size(); ++i) {
    const auto count = static_cast<uint32_t>(tiles.tiles(1 + tiles.instances()[i].model).size());
    for (uint32_t k = 0; k < count; ++k) out.push_back(tiles.first_tile(i) + k);
    fill_last_ball(out);
  }
  return out;
}

}  // namespace

TileEdges::TileEdges(gpu::Context& context, const TileTable& tiles, uint32_t interactions, const JoinedPoints& limits,
                     const BentWaves& waves)
    : place_(context),
      make_balls_(context),
      make_groups_(context),
      kernel_(context),
      rows_(context),
      limits_(limits),
      waves_(waves),
      interactions_(interactions),
      lanes_(tuning_of(context.info()).join_lanes),
      group_(tuning_of(context.info()).join_group),
      local_(context.info().simple_local_size()) {
  const std::vector<uint32_t> order = order_of_tiles(tiles);
  ball_count_ = static_cast<uint32_t>(order.size() / WT_TILE_BALL);
  order_ = context.buffer(order, {"order of tiles", advice::tiles});
  firsts_ = context.buffer<uint32_t>(tiles.size(), {"prefixes of tiles", advice::tiles});
  places_ = context.buffer<double>(4 * size_t{tiles.size()}, {"places of tiles", advice::tiles});
  strengths_ = context.buffer<float>(2 * size_t{tiles.size()}, {"strengths of tiles", advice::tiles});
  balls_ = context.buffer<wt_tile_ball>(ball_count_, {"balls of tiles", advice::tiles});
  groups_ =
      context.buffer<wt_tile_ball>((ball_count_ + WT_TILE_BALL - 1) / WT_TILE_BALL, {"groups of balls", advice::tiles});
  if (limits_.floor > 0) powers_ = context.buffer(limits_.powers, {"powers of tiles", advice::tiles});
}

void TileEdges::place(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                      const PointPrefixList& points) {
  place_({tiles.count, local_}, Stage::tile_edges,
         calls::tile_edges::place_tiles{.keys = points.keys,
                                        .prefixes = points.sorted,
                                        .receiver_of_end = ends.receiver_of_end,
                                        .powers = limits_.floor > 0 ? &powers_ : nullptr,
                                        .tiles_of = tiles.of_surfaces,
                                        .surface_of_tile = tiles.surfaces,
                                        .centres = tiles.centres,
                                        .surfaces = scene.exact_surfaces,
                                        .instances = scene.exact_instances,
                                        .places = places_,
                                        .firsts = firsts_,
                                        .strengths = strengths_,
                                        .tile_count = tiles.count,
                                        .point_count = points.rows.count,
                                        .transmitter_count = ends.transmitter_count,
                                        .hidden = points.hidden});
  make_balls_({ball_count_, local_}, Stage::tile_edges,
              calls::tile_edges::tile_balls{
                  .order = order_, .places = places_, .strengths = strengths_, .balls = balls_, .count = ball_count_});
  const auto groups = static_cast<uint32_t>(groups_.size());
  make_groups_(
      {groups, local_}, Stage::tile_edges,
      calls::tile_edges::group_balls{.balls = balls_, .groups = groups_, .count = groups, .ball_count = ball_count_});
}

uint32_t TileEdges::operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t first, uint32_t end,
                               const WedgeList& wedges, const RadioEnds& ends, const PointPrefixList& points,
                               WedgeCandidates& into, Counters& counters) {
  const size_t items = size_t{end - first} * lanes_;
  if (items == 0) return 0;
  const auto end_detour_m = static_cast<float>(WT_END_DETOUR * waves_.wavelength_m);
  return into.fill(counters, Stage::tile_edges, [&] {
    kernel_({items, group_}, Stage::tile_edges,
            calls::tile_edges::tile_edges{.keys = prefixes.keys,
                                          .prefixes = prefixes.sorted,
                                          .point_keys = points.keys,
                                          .points = points.sorted,
                                          .receiver_of_end = ends.receiver_of_end,
                                          .links = ends.links,
                                          .wedges = wedges.wedges,
                                          .surfaces = scene.surfaces,
                                          .powers = limits_.floor > 0 ? &powers_ : nullptr,
                                          .order = order_,
                                          .places = places_,
                                          .firsts = firsts_,
                                          .strengths = strengths_,
                                          .balls = balls_,
                                          .groups = groups_,
                                          .out = into.list(),
                                          .counters = counters.buffer(),
                                          .args = wt_tile_edges_arguments{.floor = limits_.floor,
                                                                          .wave_m = waves_.wave_m,
                                                                          .first = first,
                                                                          .end = end,
                                                                          .lanes = lanes_,
                                                                          .balls = ball_count_,
                                                                          .places = points.rows.count,
                                                                          .transmitter_count = ends.transmitter_count,
                                                                          .groups = ends.receiver_capacity / 16,
                                                                          .interactions = interactions_,
                                                                          .max_depth = limits_.max_depth,
                                                                          .capacity = into.capacity(),
                                                                          .end_detour_m = end_detour_m,
                                                                          .padding = 0}});
  });
}

void TileEdges::make_rows(const DeviceScene& scene, const TileBuffers& tiles, SolvedList& ways) {
  ways.open = 1;
  ways.deepest = interactions_ + 1;
  if (ways.count == 0) return;
  rows_({ways.count, local_}, Stage::tile_edges,
        calls::tile_edges::tile_rows{.places = places_,
                                     .surface_of_tile = tiles.surfaces,
                                     .surfaces = scene.exact_surfaces,
                                     .solved = ways.headers,
                                     .vertices = ways.vertices,
                                     .sequences = ways.sequences,
                                     .count = ways.count,
                                     .max_depth = ways.max_depth});
}

}  // namespace wavetracer
