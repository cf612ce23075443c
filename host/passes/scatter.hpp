// SPDX-License-Identifier: Apache-2.0
// scatter: rows of paths transmitter - tile - receiver, for the tiles of surfaces that a transmitter's rays saw
// directly. The rows are a list of their own, which occlusion and visible take like that of solve.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/scatter.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/tile_buffers.hpp"
#include "passes/tuning.hpp"
#include "scene/tiles.hpp"

namespace wavetracer {

class Scatter {
 public:
  // surface_count: that of the world. max_depth: interactions that a row has room for, at least one.
  Scatter(gpu::Context& context, const TileTable& tiles, uint32_t surface_count, uint32_t max_depth);
  // nodes: those of the trie, in any order; roots among them are skipped. Rows are in no particular order;
  // wt_solved::node is that of the tile's surface, seen from the transmitter. Throws RuntimeError, naming trace.tile_m,
  // where the rows outgrow the buffers of the device.
  SolvedList& operator()(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                         const gpu::Buffer<uint32_t>& quarters, const gpu::Buffer<uint32_t>& nodes, uint32_t node_count,
                         Counters& counters);

  const TileBuffers& tiles() const { return tiles_; }

 private:
  // Fills entries_ with all entries, and returns their number.
  uint32_t find_lit(const DeviceScene& scene, const RadioEnds& ends, const gpu::Buffer<uint64_t>& trie,
                    const gpu::Buffer<uint32_t>& nodes, uint32_t node_count, Counters& counters);
  // Returns the first row of each entry, and the number of rows after the last; the list gets room for all of them.
  std::vector<uint32_t> place_rows(uint32_t entry_count);

  gpu::Context& context_;
  TileBuffers tiles_;
  gpu::KernelOf<calls::scatter::lit> lit_;
  gpu::KernelOf<calls::scatter::scatter> scatter_;
  uint32_t local_;
  Work tiles_work_;
  gpu::Buffer<uint32_t> entries_, first_row_, count_;  // four words per entry
  SolvedList solved_;
};

}  // namespace wavetracer
