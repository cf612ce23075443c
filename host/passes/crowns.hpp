// SPDX-License-Identifier: Apache-2.0
// crowns: rows of paths transmitter - cell - receiver, for the cells of vegetation that scatters. Rays do not see
// leaves, so every link meets every cell. The rows are a list of their own, which occlusion and visible take like that
// of solve.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/crowns.hpp"
#include "passes/link_pairs.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/tuning.hpp"
#include "radio/cells.hpp"

namespace wavetracer {

class Crowns {
 public:
  // first_tile: the number of the first cell among the tiles of the world. max_depth: interactions that a row has room
  // for, at least one.
  Crowns(gpu::Context& context, const std::vector<Cell>& cells, uint32_t first_tile, uint32_t max_depth);

  // Rows are ordered by links, then by cells. Throws RuntimeError, naming trace.tile_m, where they outgrow the buffers
  // of the device.
  SolvedList& operator()(const RadioEnds& ends);

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::crowns::crowns> kernel_;
  Work work_;
  uint32_t cells_, first_tile_;
  gpu::Buffer<double> centres_;
  LinkPairs links_;
  SolvedList solved_;
};

}  // namespace wavetracer
