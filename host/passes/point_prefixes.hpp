// SPDX-License-Identifier: Apache-2.0
// point_prefixes: the tiles that the ends see by chains of mirrors, and the reflections on the way there. The rows are
// open: they end at their tile, and occlusion or transmissions tests their legs before they are placed.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/point_prefixes.hpp"
#include "passes/bend_floors.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/point_lists.hpp"
#include "passes/radio_ends.hpp"
#include "passes/tile_buffers.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

// The sequences that rays have found; nodes may be in any order, and roots among them are skipped.
struct FoundSequences {
  const gpu::Buffer<uint64_t>& table;
  const gpu::Buffer<uint32_t>&quarters, &nodes;
  uint32_t node_count = 0;
};

class PointPrefixes {
 public:
  // row_depth: interactions that a row has room for, at least one; reflections: the most mirrors
  // of a prefix, fewer than row_depth.
  PointPrefixes(gpu::Context& context, uint32_t row_depth, uint32_t reflections);
  // The most rows that are listed at once: they take at most an eighth of the device's memory.
  uint32_t most() const { return most_; }
  void set_most(uint32_t most) { most_ = most; }
  // Lists the prefixes that see tiles first to end - 1, and returns their number; if it is more than most(), they are
  // not there. floors: those of point_floors, or null: then no prefix is too weak.
  uint32_t operator()(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                      const FoundSequences& found, uint32_t first, uint32_t end, Counters& counters,
                      const gpu::Buffer<wt_point_floor>* floors = nullptr);
  PointPrefixList& list() { return list_; }
  // Makes the keys of rows whose legs have been tested; the lists have room for them.
  void make_keys(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends, PointPrefixList& list);
  // Sets list.sorted; the keys must be sorted. wedges: those of the world where prefixes may go over an edge, else
  // null.
  void place(const RadioEnds& ends, PointPrefixList& list, const gpu::Buffer<wt_wedge>* wedges = nullptr,
             const BentWaves& waves = {});
  // Throws BufferError: one tile is seen by this many prefixes.
  [[noreturn]] void refuse(uint32_t prefixes) const;

 private:
  // Fills entries_ with all entries, and returns their number.
  uint32_t find_onlookers(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends,
                          const FoundSequences& found, uint32_t first, uint32_t end, Counters& counters);
  // Writes the first row of each entry, and returns the number of rows.
  uint64_t place_rows(uint32_t entry_count);
  void reserve(size_t rows);

  gpu::Context& context_;
  gpu::KernelOf<calls::point_prefixes::onlookers> onlookers_;
  gpu::KernelOf<calls::point_prefixes::point_prefixes> kernel_;
  gpu::KernelOf<calls::point_prefixes::point_keys> keys_;
  gpu::KernelOf<calls::point_prefixes::place_points> place_;
  Work nodes_work_, rows_work_;
  uint32_t onlooker_lanes_, local_, reflections_, most_;
  gpu::Buffer<uint32_t> entries_, first_row_, count_;  // four words per entry
  PointPrefixList list_;
};

}  // namespace wavetracer
