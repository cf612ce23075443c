// SPDX-License-Identifier: Apache-2.0
// The entries of the ray cache's table at the end of a frame, one row each (output.cache_entries), for study.
// Columns of equal length, sorted by frame and slot; only entries that hold a segment have a row.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wavetracer {

struct CacheEntryRows {
  std::vector<uint32_t> frame;
  std::vector<uint32_t> slot;    // place in the table
  std::vector<uint32_t> region;  // the part of the table that belongs to one end: transmitters in their order, then,
                                 // with diffraction, the receivers that launch rays too
  std::vector<uint32_t> depth;   // number of steps of a search until it reaches the entry: 1 in the bucket itself, more
                                 // in its tree; 0: no search finds it, as another entry hides it
  std::vector<uint32_t> hits;    // answers since the region was cleared
  std::vector<uint32_t> age;     // frames since it was written: 0 in the frame that wrote it
  std::vector<double> length_m;  // length of the segment; infinite if the ray hit nothing
  std::vector<uint32_t> read_cycles;   // clock cycles of the last answer; 0: no answer yet, or a device without a clock
  std::vector<uint32_t> write_cycles;  // clock cycles of the last write

  size_t size() const { return slot.size(); }
};

}  // namespace wavetracer
