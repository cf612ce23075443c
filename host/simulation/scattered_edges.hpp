// SPDX-License-Identifier: Apache-2.0
// The passes of paths that scatter from a tile and have an edge beside it, before it or after it. tile_edges and
// wedge_solve find the ways over one edge to tiles that the other end sees by mirrors or directly; they are sorted
// among the prefixes of tiles, and joined with them. The prefixes of both must be there, sorted.
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "passes/bend_floors.hpp"
#include "passes/point_join.hpp"
#include "passes/point_prefixes.hpp"
#include "passes/sort.hpp"
#include "passes/tile_edges.hpp"
#include "passes/visible.hpp"
#include "passes/wedge_solve.hpp"
#include "simulation/scattered_paths.hpp"
#include "simulation/seen_edges.hpp"

namespace wavetracer {

// Warns before a frame where the prefixes of edges may be too many for the tiles, if each of `ends` sees each edge
// once; empty where they are not, or where there is a floor. How many there are is known in the frame alone.
std::string warning_of_pairs(uint64_t ends, uint64_t edges, uint64_t tiles, bool has_floor);

class ScatteredEdges {
 public:
  // interactions: the most before a tile and after it; waves: see TileEdges.
  ScatteredEdges(gpu::Context& context, const TileTable& tiles, uint32_t interactions, JoinedPoints limits,
                 const BentWaves& waves);

  // Tests the legs of open rows.
  using CheckLegs = std::function<void(SolvedList& rows, Counters& counters)>;
  // Makes all paths of the tiles that the prefixes of `points` see, and returns their counts. take: takes paths whose
  // legs have been tested. Throws RuntimeError where there are too many pairs of edges and tiles to try without a
  // floor.
  JoinedCounts operator()(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                          const FoundSequences& found, const SeenEdges& edges, PointPrefixes& points,
                          const CheckLegs& check_legs, const std::function<void(SolvedList&)>& take);

 private:
  // Lists the ways whose legs are free and the prefixes of `points` together, in the order of their tiles. Returns
  // whether there are such ways.
  bool sort(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends, const SeenEdges& edges,
            PointPrefixes& points, const SolvedList& ways);

  gpu::Context& context_;
  BentWaves waves_;
  double floor_;
  Counters counters_;
  TileEdges pass_;
  WedgeSolve solve_;
  Visible all_;  // the ways and prefixes that nothing obstructs
  Sort sort_;
  PointJoin join_;
  PointPrefixList list_;
};

}  // namespace wavetracer
