// SPDX-License-Identifier: Apache-2.0
// tile_edges: candidates of ways over one edge to tiles, from the prefixes of all ends that see the edge, and rows of
// the ways that wedge_solve has solved. Tiles that no end sees by mirrors or directly have none.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/tile_edges.hpp"
#include "passes/bend_floors.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/point_join.hpp"
#include "passes/point_lists.hpp"
#include "passes/radio_ends.hpp"
#include "passes/tile_buffers.hpp"
#include "passes/wedge_candidates.hpp"
#include "passes/wedge_lists.hpp"
#include "scene/tiles.hpp"

namespace wavetracer {

class TileEdges {
 public:
  // interactions: the most of a way, its edge included; limits: those of the paths that point_join makes of them.
  TileEdges(gpu::Context& context, const TileTable& tiles, uint32_t interactions, const JoinedPoints& limits,
            const BentWaves& waves);
  // Finds the tiles that `points`, sorted and placed, see, and where they are in this frame.
  void place(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends, const PointPrefixList& points);
  // prefixes: sorted by their keys; those from first to end - 1 are taken. The receiver of a candidate is the number of
  // its tile. Returns the number of candidates, as WedgeCandidates::fill() does.
  uint32_t operator()(const DeviceScene& scene, const WedgePrefixList& prefixes, uint32_t first, uint32_t end,
                      const WedgeList& wedges, const RadioEnds& ends, const PointPrefixList& points,
                      WedgeCandidates& into, Counters& counters);
  // The places of the tiles, in the form of RadioEnds::receivers.
  const gpu::Buffer<double>& places() const { return places_; }
  // Makes open rows of ways, whose receivers are tiles.
  void make_rows(const DeviceScene& scene, const TileBuffers& tiles, SolvedList& ways);

 private:
  gpu::KernelOf<calls::tile_edges::place_tiles> place_;
  gpu::KernelOf<calls::tile_edges::tile_balls> make_balls_;
  gpu::KernelOf<calls::tile_edges::group_balls> make_groups_;
  gpu::KernelOf<calls::tile_edges::tile_edges> kernel_;
  gpu::KernelOf<calls::tile_edges::tile_rows> rows_;
  JoinedPoints limits_;
  BentWaves waves_;
  uint32_t interactions_, lanes_, group_, local_, ball_count_ = 0;
  gpu::Buffer<double> powers_;  // made only with a floor
  gpu::Buffer<uint32_t> order_, firsts_;
  gpu::Buffer<double> places_;    // four for each tile
  gpu::Buffer<float> strengths_;  // two for each tile
  gpu::Buffer<wt_tile_ball> balls_, groups_;
};

}  // namespace wavetracer
