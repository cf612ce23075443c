// SPDX-License-Identifier: Apache-2.0
// The passes of paths that scatter from a tile and are reflected before or after it: prefixes of both ends are sorted
// by the tiles that they see, and joined there. Both ends of every link must have launched, and place must have run.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "base/environment.hpp"
#include "passes/growing_list.hpp"
#include "passes/point_join.hpp"
#include "passes/point_prefixes.hpp"
#include "passes/sort.hpp"
#include "simulation/frame_account.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

struct ScatteredPaths {
  // reflections: the most before a tile and after it.
  ScatteredPaths(gpu::Context& context, uint32_t reflections, JoinedPoints limits)
      : prefixes(context, limits.row_depth, reflections), join(context, std::move(limits)), sort_(context) {
    // With this, tests need no scene of millions of paths.
    if (const std::string most = environment("WAVETRACER_MOST_POINTS"); !most.empty()) {
      const auto least = static_cast<uint32_t>(std::max(std::atol(most.c_str()), 1L));
      prefixes.set_most(least);
      join.set_most(least);
    }
  }

  // Puts prefixes whose legs have been tested in the order of the tiles that they see.
  void sort(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends) {
    PointPrefixList& list = prefixes.list();
    prefixes.make_keys(scene, tiles, ends);
    if (list.rows.count > 0) sort_(list.keys, list.order, list.rows.count, list.key_bits());
    prefixes.place(ends);
  }

  PointPrefixes prefixes;
  PointJoin join;

 private:
  Sort sort_;
};

// Counts of joined paths.
struct JoinedCounts {
  uint64_t paths = 0;
  uint64_t weak = 0;  // those that were left out, because they are surely below a floor

  void add_to(Uncounted& counts) const {
    counts.candidates += paths;
    counts.solved += paths;
    counts.weak += weak;
  }
};

// Makes all paths, for a part of the tiles at a time where the prefixes of all do not fit into a list, and from a part
// of these where their paths do not. check_legs(rows): tests the legs of open rows; take(rows): takes paths.
// told(done): is called before another part, with the number of tiles that are done.
template <class CheckLegs, class Take, class Told>
JoinedCounts join_points(ScatteredPaths& scattered, const DeviceScene& scene, const TileBuffers& tiles,
                         const RadioEnds& ends, const FoundSequences& found, Counters& counters,
                         const CheckLegs& check_legs, const Take& take, const Told& told) {
  JoinedCounts out;
  const auto join_all = [&] {
    const PointPrefixList& list = scattered.prefixes.list();
    by_parts(
        list.rows.count, list.rows.count, scattered.join.most(),
        [&](uint32_t first, uint32_t end) { return scattered.join(list, first, end, ends); },  // point_join
        [&](uint32_t joined) {
          take(scattered.join.list());
          out.paths += joined;
          out.weak += scattered.join.weak();
        },
        [](uint32_t) {}, [&](uint32_t paths) { scattered.join.refuse(paths); });
  };
  by_parts(
      tiles.count, tiles.count, scattered.prefixes.most(),
      [&](uint32_t first, uint32_t end) {
        return scattered.prefixes(scene, tiles, ends, found, first, end, counters);  // point_prefixes
      },
      [&](uint32_t prefixes) {
        if (prefixes == 0) return;
        check_legs(scattered.prefixes.list().rows);
        scattered.sort(scene, tiles, ends);  // point_prefixes, sort
        join_all();
      },
      told, [&](uint32_t prefixes) { scattered.prefixes.refuse(prefixes); });
  return out;
}

}  // namespace wavetracer
