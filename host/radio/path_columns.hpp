// SPDX-License-Identifier: Apache-2.0
// Paths as columns, from the records that fields write.
#pragma once
#include <cstdint>
#include <span>

#include "wavetracer/device/field_records.h"
#include "wavetracer/frame_result.hpp"

namespace wavetracer {

struct Ports {
  uint32_t tx = 1, rx = 1;  // the most ports of any end of that side
};

// Numbers of rows and of their vertices.
struct RowCounts {
  uint32_t rows = 0, vertices = 0;
  bool operator==(const RowCounts&) const = default;
};

// The rows of a frame in their order, and the vertices of all rows, one after the other.
struct FrameRows {
  std::span<const device::wt_path_row> rows;
  std::span<const device::wt_vertex_row> vertices;
  uint32_t frame = 0;
};

// Paths of one frame with room for so many rows and vertices, which are not filled. room: paths that are needed no
// more; where they have the memory, the columns take it, and this costs nearly nothing.
Paths sized_columns(RowCounts counts, Ports ports, Paths room = {});
// Makes room for another number of them; what was filled is lost.
void size_columns(Paths& paths, RowCounts counts);
// Fills paths of the sizes of `from`, but for the columns of groups. Returns the number of rows that have
// WT_ROW_NEAR_EDGE.
uint32_t fill_columns(Paths& paths, const FrameRows& from);
// Does the same for the part from `first` up to `end`, of which the records must be there. Parts are filled in their
// order, and together they must be all rows and vertices.
uint32_t fill_part(Paths& paths, const FrameRows& from, RowCounts first, RowCounts end);
// Fills the columns that differ for the same rows at another carrier; returns the same number.
uint32_t fill_carrier(CarrierFields& fields, std::span<const device::wt_path_row> rows, Ports ports);
// Makes the columns and fills them.
Paths columns_of(const FrameRows& from, Ports ports);

}  // namespace wavetracer
