// SPDX-License-Identifier: Apache-2.0
// Columns of paths: filled at once and in parts, in new memory and in that of other paths.
#include "radio/path_columns.hpp"

#include <doctest/doctest.h>

#include <random>

#include "radio/column_room.hpp"

using namespace wavetracer;

namespace {

struct Records {
  std::vector<device::wt_path_row> rows;
  std::vector<device::wt_vertex_row> vertices;
  std::vector<uint32_t> depths;

  RowCounts counts() const { return {static_cast<uint32_t>(rows.size()), static_cast<uint32_t>(vertices.size())}; }
  FrameRows of_frame(uint32_t frame) const { return {rows, vertices, frame}; }
};

// Every value differs from that of other rows.
Records made_records(uint32_t count) {
  std::mt19937 engine(count);
  Records out;
  for (uint32_t i = 0; i < count; ++i) {
    const double x = i + 0.5;
    device::wt_path_row& row = out.rows.emplace_back();
    row = {.delay_s = x,
           .gain_db = -x,
           .doppler_hz = 2 * x,
           .aod_theta = 3 * x,
           .aod_phi = 4 * x,
           .aoa_theta = 5 * x,
           .aoa_phi = 6 * x,
           .a = {x, 7 * x, 8 * x, 9 * x, 10 * x, 11 * x, 12 * x, 13 * x},
           .tx = i / 100,
           .rx = i / 10,
           .first_vertex = static_cast<uint32_t>(out.vertices.size()),
           .quarters = i % 16 | (i % 3 == 0 ? WT_ROW_NEAR_EDGE : 0)};
    out.depths.push_back(engine() % 4);
    for (uint32_t k = 0; k < out.depths.back(); ++k)
      out.vertices.push_back({{x, x + k, -x}, i + k, i + 2 * k, 1u << k, 0});
  }
  return out;
}

void check(const Paths& paths, const Records& from, uint32_t frame) {
  const size_t rows = from.rows.size(), vertices = from.vertices.size();
  for (const size_t size :
       {paths.frame.size(), paths.tx.size(), paths.rx.size(), paths.depth.size(), paths.delay_s.size(),
        paths.gain_db.size(), paths.a.size(), paths.aod_theta_rad.size(), paths.aod_phi_rad.size(),
        paths.aoa_theta_rad.size(), paths.aoa_phi_rad.size(), paths.doppler_hz.size(), paths.quarters.size()})
    REQUIRE(size == rows);
  for (const size_t size : {paths.vertex_position_m.size(), paths.vertex_interaction.size(),
                            paths.vertex_surface.size(), paths.vertex_instance.size()})
    REQUIRE(size == vertices);
  REQUIRE(paths.vertex_offset.size() == rows + 1);
  CHECK(paths.vertex_offset[rows] == vertices);
  CHECK(paths.depth == from.depths);
  CHECK(paths.frame == std::vector<uint32_t>(rows, frame));
  CHECK(paths.group.empty());
  CHECK(paths.group_weight.empty());
  bool same = true;
  for (size_t i = 0; i < rows; ++i) {
    const device::wt_path_row& row = from.rows[i];
    same = same && paths.tx[i] == row.tx && paths.rx[i] == row.rx && paths.delay_s[i] == row.delay_s &&
           paths.gain_db[i] == row.gain_db && paths.doppler_hz[i] == row.doppler_hz &&
           paths.aod_theta_rad[i] == row.aod_theta && paths.aod_phi_rad[i] == row.aod_phi &&
           paths.aoa_theta_rad[i] == row.aoa_theta && paths.aoa_phi_rad[i] == row.aoa_phi &&
           paths.quarters[i] == i % 16 && paths.vertex_offset[i] == row.first_vertex;
    const std::array<std::complex<double>, 4> a{{{row.a[0], row.a[1]}, {row.a[4], row.a[5]}, {}, {}}};
    same = same && paths.a[i] == a;
  }
  for (size_t at = 0; at < vertices; ++at) {
    const device::wt_vertex_row& vertex = from.vertices[at];
    same =
        same && paths.vertex_position_m[at] == glm::dvec3(vertex.position[0], vertex.position[1], vertex.position[2]);
    same = same && paths.vertex_interaction[at] == vertex.interaction && paths.vertex_surface[at] == vertex.surface &&
           paths.vertex_instance[at] == vertex.instance;
  }
  CHECK(same);
}

constexpr Ports ports{.tx = 1, .rx = 2};

// The number of rows near edges among the first.
uint32_t near(uint32_t rows) { return (rows + 2) / 3; }

}  // namespace

TEST_CASE("columns have the values of their records, also in the memory of more and of fewer paths") {
  Paths paths;
  for (const uint32_t rows : {2000u, 3000u, 0u, 1u, 2500u}) {
    CAPTURE(rows);
    const Records records = made_records(rows);
    paths.group.resize(7);
    paths.group_weight.resize(7);
    paths = sized_columns(records.counts(), ports, std::move(paths));
    CHECK(fill_columns(paths, records.of_frame(rows + 1)) == near(rows));
    CHECK(paths.tx_ports == 1);
    CHECK(paths.rx_ports == 2);
    check(paths, records, rows + 1);
    check(columns_of(records.of_frame(4), ports), records, 4);
  }
}

TEST_CASE("parts fill the same columns as all rows at once, wherever they end") {
  const Records records = made_records(3000);
  const RowCounts all = records.counts();
  for (const std::vector<RowCounts>& ends : {std::vector<RowCounts>{{1, 0}, {2, all.vertices}, all},
                                             {{1500, 3}, {1500, 4}, {all.rows, 7}, all},
                                             {{0, 0}, {2999, all.vertices}, all},
                                             {all, all}}) {
    CAPTURE(ends.front().rows);
    Paths paths = sized_columns(all, ports, columns_of(made_records(5000).of_frame(3), ports));
    uint32_t near_edges = 0;
    RowCounts from;
    for (const RowCounts& to : ends) {
      near_edges += fill_part(paths, records.of_frame(9), from, to);
      from = to;
    }
    CHECK(near_edges == near(all.rows));
    check(paths, records, 9);
  }
}

TEST_CASE("columns keep their memory while it is large enough, and grow with room to spare") {
  std::vector<int> column;
  size_column(column, 100);
  CHECK(column.capacity() == 100);  // nothing to spare for one that is used once
  const int* const memory = column.data();
  size_column(column, 0);
  size_column(column, 100);
  CHECK(column.data() == memory);
  CHECK(column.size() == 100);
  size_column(column, 160);
  CHECK(column.size() == 160);
  CHECK(column.capacity() == 180);
}
