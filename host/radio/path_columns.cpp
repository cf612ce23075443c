// SPDX-License-Identifier: Apache-2.0
// All cores take part. Values of new memory are set twice, since vectors set them to zero first.
#include "radio/path_columns.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "radio/column_room.hpp"

namespace wavetracer {
namespace {

void size_numbers(Paths& paths, size_t rows) {
  for (auto* column : {&paths.frame, &paths.tx, &paths.rx, &paths.depth}) size_column(*column, rows);
  size_column(paths.quarters, rows);
  size_column(paths.vertex_offset, rows + 1);
}

void size_values(Paths& paths, size_t rows) {
  for (auto* column : {&paths.delay_s, &paths.gain_db, &paths.doppler_hz, &paths.aod_theta_rad, &paths.aod_phi_rad,
                       &paths.aoa_theta_rad, &paths.aoa_phi_rad})
    size_column(*column, rows);
}

void size_vertices(Paths& paths, size_t vertices) {
  size_column(paths.vertex_interaction, vertices);
  size_column(paths.vertex_surface, vertices);
  size_column(paths.vertex_instance, vertices);
}

std::array<std::complex<double>, 4> port_matrix(const device::wt_path_row& from, Ports ports) {
  std::array<std::complex<double>, 4> a{};
  for (uint32_t r = 0; r < ports.rx; ++r)
    for (uint32_t t = 0; t < ports.tx; ++t)
      a[r * ports.tx + t] = {from.a[2 * (2 * r + t)], from.a[2 * (2 * r + t) + 1]};
  return a;
}

RowCounts counts_of(const FrameRows& of) {
  return {static_cast<uint32_t>(of.rows.size()), static_cast<uint32_t>(of.vertices.size())};
}

void take_row(Paths& paths, size_t row, const device::wt_path_row& from, uint32_t frame) {
  paths.frame[row] = frame;
  paths.tx[row] = from.tx;
  paths.rx[row] = from.rx;
  paths.vertex_offset[row] = from.first_vertex;
  paths.quarters[row] = static_cast<uint8_t>(from.quarters);
  paths.delay_s[row] = from.delay_s;
  paths.gain_db[row] = from.gain_db;
  paths.doppler_hz[row] = from.doppler_hz;
  paths.aod_theta_rad[row] = from.aod_theta;
  paths.aod_phi_rad[row] = from.aod_phi;
  paths.aoa_theta_rad[row] = from.aoa_theta;
  paths.aoa_phi_rad[row] = from.aoa_phi;
  paths.a[row] = port_matrix(from, {paths.tx_ports, paths.rx_ports});
}

void take_vertex(Paths& paths, uint64_t at, const device::wt_vertex_row& from) {
  paths.vertex_position_m[at] = {from.position[0], from.position[1], from.position[2]};
  paths.vertex_interaction[at] = static_cast<uint8_t>(from.interaction);
  paths.vertex_surface[at] = from.surface;
  paths.vertex_instance[at] = from.instance;
}

}  // namespace

Paths sized_columns(RowCounts counts, Ports ports, Paths room) {
  Paths paths = std::move(room);
  paths.tx_ports = ports.tx;
  paths.rx_ports = ports.rx;
  paths.group.clear();
  paths.group_weight.clear();
  paths.lifetime_m.clear();
  paths.target.clear();
  size_columns(paths, counts);
  return paths;
}

void size_columns(Paths& paths, RowCounts counts) {
  tbb::parallel_invoke([&] { size_column(paths.a, counts.rows); }, [&] { size_numbers(paths, counts.rows); },
                       [&] { size_values(paths, counts.rows); },
                       [&] { size_column(paths.vertex_position_m, counts.vertices); },
                       [&] { size_vertices(paths, counts.vertices); });
}

// The depth of a row is filled with the row after it, whose first vertex ends it.
uint32_t fill_part(Paths& paths, const FrameRows& from, RowCounts first, RowCounts end) {
  const std::span rows = from.rows;
  const std::span vertices = from.vertices;
  std::atomic<uint32_t> near_edges = 0;
  const auto take_rows = [&](const tbb::blocked_range<uint32_t>& range) {
    uint32_t near = 0;
    for (uint32_t row = range.begin(); row < range.end(); ++row) {
      take_row(paths, row, rows[row], from.frame);
      near += (rows[row].quarters & WT_ROW_NEAR_EDGE) != 0;
      if (row > 0) paths.depth[row - 1] = rows[row].first_vertex - rows[row - 1].first_vertex;
    }
    if (near > 0) near_edges += near;
  };
  const auto take_vertices = [&](const tbb::blocked_range<uint32_t>& range) {
    for (uint32_t at = range.begin(); at < range.end(); ++at) take_vertex(paths, at, vertices[at]);
  };
  tbb::parallel_invoke(
      [&] { tbb::parallel_for(tbb::blocked_range<uint32_t>(first.rows, end.rows, 256), take_rows); },
      [&] { tbb::parallel_for(tbb::blocked_range<uint32_t>(first.vertices, end.vertices, 1024), take_vertices); });
  if (end.rows == rows.size()) {
    paths.vertex_offset[end.rows] = vertices.size();
    if (end.rows > 0) paths.depth[end.rows - 1] = static_cast<uint32_t>(vertices.size()) - rows.back().first_vertex;
  }
  return near_edges;
}

uint32_t fill_columns(Paths& paths, const FrameRows& from) { return fill_part(paths, from, {}, counts_of(from)); }

uint32_t fill_carrier(CarrierFields& fields, std::span<const device::wt_path_row> rows, Ports ports) {
  std::atomic<uint32_t> near_edges = 0;
  fields.a.resize(rows.size());
  fields.gain_db.resize(rows.size());
  fields.doppler_hz.resize(rows.size());
  tbb::parallel_for(size_t{0}, rows.size(), [&](size_t row) {
    fields.a[row] = port_matrix(rows[row], ports);
    fields.gain_db[row] = rows[row].gain_db;
    fields.doppler_hz[row] = rows[row].doppler_hz;
    if (rows[row].quarters & WT_ROW_NEAR_EDGE) ++near_edges;
  });
  return near_edges;
}

Paths columns_of(const FrameRows& from, Ports ports) {
  Paths paths = sized_columns(counts_of(from), ports);
  fill_columns(paths, from);
  return paths;
}

}  // namespace wavetracer
