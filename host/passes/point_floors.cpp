// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/point_floors.cl.
// A work-item takes one tile.
#include "passes/point_floors.hpp"

#include "passes/advice.hpp"

namespace wavetracer {
namespace {

// A way and its path are measured along other lines, so their lengths differ by rounding.
constexpr double rounding_of_ways = 1e-6;

}  // namespace

PointFloors::PointFloors(gpu::Context& context, double floor, const std::vector<double>& powers, bool beside_edge)
    : kernel_(context),
      local_(context.info().simple_local_size()),
      floor_(floor * (1 - rounding_of_ways) / (beside_edge ? WT_MOST_OF_EDGE : 1.0)),
      powers_(context.buffer(powers, {"powers of tiles", advice::tiles})),
      list_(context.buffer<wt_point_floor>(powers.size(), {"floors of tiles", advice::tiles})) {}

void PointFloors::operator()(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends) {
  kernel_({tiles.count, local_}, Stage::point_prefixes,
          calls::point_floors::point_floors{.transmitters = ends.transmitters,
                                            .receivers = ends.receivers,
                                            .tiles_of = tiles.of_surfaces,
                                            .surface_of_tile = tiles.surfaces,
                                            .centres = tiles.centres,
                                            .surfaces = scene.exact_surfaces,
                                            .instances = scene.exact_instances,
                                            .powers = powers_,
                                            .out = list_,
                                            .tile_count = tiles.count,
                                            .transmitter_count = ends.transmitter_count,
                                            .receiver_count = ends.receiver_count,
                                            .least_gain = floor_});
}

}  // namespace wavetracer
