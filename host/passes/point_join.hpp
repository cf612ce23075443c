// SPDX-License-Identifier: Apache-2.0
// point_join: paths over tiles with reflections before or after them, from prefixes of both ends that see one tile.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/point_join.hpp"
#include "passes/point_lists.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"

namespace wavetracer {

// The limits of the paths that are joined.
struct JoinedPoints {
  uint32_t max_depth = 1;      // most interactions of a path
  uint32_t transmissions = 0;  // most transmissions of a path
  uint32_t diffractions = 0;   // most diffractions of a path
  uint32_t bends = 0;          // fewest diffractions of a path
  uint32_t row_depth = 1;      // interactions that a row has room for
  double floor = 0;            // gain below which a path is left out; 0: none is
  // With a floor: for each tile a bound of the gain of paths whose parts before and after it are 1 m long.
  std::vector<double> powers = {};
};

class PointJoin {
 public:
  PointJoin(gpu::Context& context, JoinedPoints limits);
  // The most paths that are listed at once: they take at most a quarter of the device's memory.
  uint32_t most() const { return most_; }
  void set_most(uint32_t most) { most_ = most; }
  // prefixes: sorted and placed; first to end - 1 of them serve as those of transmitters. Returns the number of paths;
  // if it is more than most(), they are not there.
  uint32_t operator()(const PointPrefixList& prefixes, uint32_t first, uint32_t end, const RadioEnds& ends);
  SolvedList& list() { return list_; }
  // The number of paths that the last call left out, because they are surely below the floor.
  uint64_t weak() const { return weak_; }
  // Throws BufferError: one prefix has this many paths.
  [[noreturn]] void refuse(uint32_t paths) const;

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::point_join::point_join> kernel_;
  JoinedPoints limits_;
  uint32_t lanes_, group_, most_;
  gpu::Buffer<double> powers_;  // made only with a floor
  gpu::Buffer<uint32_t> counts_;
  SolvedList list_;
  uint64_t weak_ = 0;
};

}  // namespace wavetracer
