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

// Paths of one frame with room for this many rows and vertices. Their pages are touched, which takes most of the time.
Paths sized_columns(size_t rows, size_t vertices, uint32_t frame, Ports ports);
// Makes room for another number of them.
void resize_columns(Paths& paths, size_t rows, size_t vertices, uint32_t frame);
// Fills paths of these sizes. rows: in their order; vertices: those of all rows, one after the other. Returns the
// number of rows that have WT_ROW_NEAR_EDGE.
uint32_t fill_columns(Paths& paths, std::span<const device::wt_path_row> rows,
                      std::span<const device::wt_vertex_row> vertices);
// Fills the columns that differ for the same rows at another carrier; returns the same number.
uint32_t fill_carrier(CarrierFields& fields, std::span<const device::wt_path_row> rows, Ports ports);
// Makes the columns and fills them.
Paths columns_of(std::span<const device::wt_path_row> rows, std::span<const device::wt_vertex_row> vertices,
                 uint32_t frame, Ports ports);

}  // namespace wavetracer
