// SPDX-License-Identifier: Apache-2.0
// The passes of paths that scatter from a tile and are reflected before or after it: prefixes of both ends are sorted
// by the tiles that they see, and joined there. Both ends of every link must have launched, and place must have run.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "base/environment.hpp"
#include "passes/growing_list.hpp"
#include "passes/point_floors.hpp"
#include "passes/point_join.hpp"
#include "passes/point_prefixes.hpp"
#include "passes/sort.hpp"
#include "simulation/frame_account.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

// The room of lists of prefixes and paths that a test asks for, so that it needs no scene of millions of paths.
inline std::optional<uint32_t> most_points_of_tests() {
  const std::string most = environment("WAVETRACER_MOST_POINTS");
  if (most.empty()) return {};
  return static_cast<uint32_t>(std::max(std::atol(most.c_str()), 1L));
}

struct ScatteredPaths {
  // reflections: the most before a tile and after it; beside_edge: see PointFloors.
  ScatteredPaths(gpu::Context& context, uint32_t reflections, const JoinedPoints& limits, bool beside_edge)
      : prefixes(context, limits.row_depth, reflections), join(context, limits), sort_(context) {
    if (limits.floor > 0) floors.emplace(context, limits.floor, limits.powers, beside_edge);
    if (const auto least = most_points_of_tests()) {
      prefixes.set_most(*least);
      join.set_most(*least);
    }
  }

  // Puts prefixes whose legs have been tested in the order of the tiles that they see.
  void sort(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends) {
    PointPrefixList& list = prefixes.list();
    prefixes.make_keys(scene, tiles, ends, list);
    if (list.rows.count > 0) sort_(list.keys, list.order, list.rows.count, list.key_bits());
    prefixes.place(ends, list);
  }

  PointPrefixes prefixes;
  PointJoin join;
  std::optional<PointFloors> floors;  // given with a floor

 private:
  Sort sort_;
};

// Counts of joined paths.
struct JoinedCounts {
  uint64_t paths = 0;
  uint64_t weak = 0;  // those that were left out, because they are surely below a floor

  JoinedCounts& operator+=(const JoinedCounts& other) {
    paths += other.paths;
    weak += other.weak;
    return *this;
  }
  void add_to(Uncounted& counts) const {
    counts.candidates += paths;
    counts.solved += paths;
    counts.weak += weak;
  }
};

// Makes all paths of sorted prefixes, from a part of them at a time where the paths of all do not fit into a list.
// take(rows): takes paths.
template <class Take>
JoinedCounts join_prefixes_of_points(PointJoin& join, const PointPrefixList& list, const RadioEnds& ends,
                                     const Take& take) {
  JoinedCounts out;
  by_parts(
      list.rows.count, list.rows.count, join.most(),
      [&](uint32_t first, uint32_t end) { return join(list, first, end, ends); },  // point_join
      [&](uint32_t joined) {
        take(join.list());
        out.paths += joined;
        out.weak += join.weak();
      },
      [](uint32_t) {}, [&](uint32_t paths) { join.refuse(paths); });
  return out;
}

// Makes all paths, for a part of the tiles at a time where the prefixes of all do not fit into a list.
// check_legs(rows): tests the legs of open rows; take(rows): takes paths; beside_edges(): makes the paths with an edge
// beside a tile from the prefixes that are there, and returns their counts; told(done): is called before another part,
// with the number of tiles that are done.
template <class CheckLegs, class Take, class BesideEdges, class Told>
JoinedCounts join_points(ScatteredPaths& scattered, const DeviceScene& scene, const TileBuffers& tiles,
                         const RadioEnds& ends, const FoundSequences& found, Counters& counters,
                         const CheckLegs& check_legs, const Take& take, const BesideEdges& beside_edges,
                         const Told& told) {
  JoinedCounts out;
  if (scattered.floors) (*scattered.floors)(scene, tiles, ends);  // point_floors
  by_parts(
      tiles.count, tiles.count, scattered.prefixes.most(),
      [&](uint32_t first, uint32_t end) {
        return scattered.prefixes(scene, tiles, ends, found, first, end, counters,
                                  scattered.floors ? &scattered.floors->list() : nullptr);  // point_prefixes
      },
      [&](uint32_t prefixes) {
        if (prefixes == 0) return;
        check_legs(scattered.prefixes.list().rows);
        scattered.sort(scene, tiles, ends);  // point_prefixes, sort
        out += join_prefixes_of_points(scattered.join, scattered.prefixes.list(), ends, take);
        out += beside_edges();
      },
      told, [&](uint32_t prefixes) { scattered.prefixes.refuse(prefixes); });
  return out;
}

}  // namespace wavetracer
