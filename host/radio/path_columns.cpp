// SPDX-License-Identifier: Apache-2.0
// All cores take part: most of the time is spent on pages that are touched first.
#include "radio/path_columns.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>

namespace wavetracer {
namespace {

void resize_numbers(Paths& paths, size_t rows, uint32_t frame) {
  for (auto* column : {&paths.tx, &paths.rx, &paths.depth}) column->resize(rows);
  paths.frame.resize(rows, frame);
  paths.quarters.resize(rows);
  paths.vertex_offset.resize(rows + 1);
}

void resize_values(Paths& paths, size_t rows) {
  for (auto* column : {&paths.delay_s, &paths.gain_db, &paths.doppler_hz, &paths.aod_theta_rad, &paths.aod_phi_rad,
                       &paths.aoa_theta_rad, &paths.aoa_phi_rad})
    column->resize(rows);
}

void resize_vertices(Paths& paths, size_t vertices) {
  paths.vertex_interaction.resize(vertices);
  paths.vertex_surface.resize(vertices);
  paths.vertex_instance.resize(vertices);
}

std::array<std::complex<double>, 4> port_matrix(const device::wt_path_row& from, Ports ports) {
  std::array<std::complex<double>, 4> a{};
  for (uint32_t r = 0; r < ports.rx; ++r)
    for (uint32_t t = 0; t < ports.tx; ++t)
      a[r * ports.tx + t] = {from.a[2 * (2 * r + t)], from.a[2 * (2 * r + t) + 1]};
  return a;
}

void take_row(Paths& paths, size_t row, const device::wt_path_row& from) {
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

Paths sized_columns(size_t rows, size_t vertices, uint32_t frame, Ports ports) {
  Paths paths;
  paths.tx_ports = ports.tx;
  paths.rx_ports = ports.rx;
  tbb::parallel_invoke([&] { paths.a.resize(rows); }, [&] { resize_numbers(paths, rows, frame); },
                       [&] { resize_values(paths, rows); }, [&] { paths.vertex_position_m.resize(vertices); },
                       [&] { resize_vertices(paths, vertices); });
  return paths;
}

void resize_columns(Paths& paths, size_t rows, size_t vertices, uint32_t frame) {
  paths.a.resize(rows);
  resize_numbers(paths, rows, frame);
  resize_values(paths, rows);
  paths.vertex_position_m.resize(vertices);
  resize_vertices(paths, vertices);
}

uint32_t fill_columns(Paths& paths, std::span<const device::wt_path_row> rows,
                      std::span<const device::wt_vertex_row> vertices) {
  paths.vertex_offset[rows.size()] = vertices.size();
  std::atomic<uint32_t> near_edges = 0;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, rows.size(), 256), [&](const tbb::blocked_range<size_t>& range) {
    uint32_t near = 0;
    for (size_t row = range.begin(); row < range.end(); ++row) {
      take_row(paths, row, rows[row]);
      near += (rows[row].quarters & WT_ROW_NEAR_EDGE) != 0;
      const size_t end = row + 1 < rows.size() ? rows[row + 1].first_vertex : vertices.size();
      paths.depth[row] = static_cast<uint32_t>(end - rows[row].first_vertex);
    }
    if (near > 0) near_edges += near;
  });
  tbb::parallel_for(tbb::blocked_range<size_t>(0, vertices.size(), 1024), [&](const tbb::blocked_range<size_t>& range) {
    for (size_t at = range.begin(); at < range.end(); ++at) take_vertex(paths, at, vertices[at]);
  });
  return near_edges;
}

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

Paths columns_of(std::span<const device::wt_path_row> rows, std::span<const device::wt_vertex_row> vertices,
                 uint32_t frame, Ports ports) {
  Paths paths = sized_columns(rows.size(), vertices.size(), frame, ports);
  fill_columns(paths, rows, vertices);
  return paths;
}

}  // namespace wavetracer
