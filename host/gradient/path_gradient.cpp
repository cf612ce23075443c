// SPDX-License-Identifier: Apache-2.0
#include "gradient/path_gradient.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "gradient/path_gaps.hpp"
#include "gradient/path_tables.hpp"
#include "radio/field_frame.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using tangent::Tangent;

// One path's columns with their derivatives.
struct PathColumns {
  std::array<std::pair<Tangent, Tangent>, 4> a;  // in the order of Paths::a
  std::array<Tangent, 5> real;                   // delay, then the angles of departure and arrival
};

PathColumns columns_of_field(const tangent::wt_path_field& field, const Tangent& delay, Ports ports) {
  PathColumns out{};
  for (uint32_t r = 0; r < ports.rx; ++r)
    for (uint32_t t = 0; t < ports.tx; ++t) out.a[r * ports.tx + t] = {field.a[2 * r + t].x, field.a[2 * r + t].y};
  out.real = {delay, field.departure.theta, field.departure.phi, field.arrival.theta, field.arrival.phi};
  return out;
}

// The function that is differentiated is the one that gave the path's columns, to the last bit.
void check_values(const PathColumns& columns, const Paths& paths, size_t row) {
  bool same = true;
  const auto compare = [&](const Tangent& own, double value) {
    same = same && (own.value == value || (std::isnan(own.value) && std::isnan(value)));
  };
  for (size_t i = 0; i < 4; ++i) {
    compare(columns.a[i].first, paths.a[row][i].real());
    compare(columns.a[i].second, paths.a[row][i].imag());
  }
  const double real[5] = {paths.delay_s[row], paths.aod_theta_rad[row], paths.aod_phi_rad[row],
                          paths.aoa_theta_rad[row], paths.aoa_phi_rad[row]};
  for (size_t i = 0; i < 5; ++i) compare(columns.real[i], real[i]);
  if (!same)
    throw std::logic_error(
        fmt::format("path {}: the code of its derivatives gives another field than that of fields; "
                    "cmake/tangent_headers.py must know the headers of the device",
                    row));
}

// Writes entry `at`, the derivatives in one direction.
void write_entry(ModelGradients& to, size_t at, const PathDirection& direction, const PathColumns& columns, int lane,
                 GradientGap known_gap) {
  std::array<std::complex<double>, 4> slopes_a;
  std::array<double, 5> slopes;
  bool finite = true;
  const auto slope_of = [&](const Tangent& column) {
    const double slope = column.d[lane];
    finite = finite && std::isfinite(slope);
    return slope;
  };
  for (size_t i = 0; i < 4; ++i) slopes_a[i] = {slope_of(columns.a[i].first), slope_of(columns.a[i].second)};
  for (size_t i = 0; i < 5; ++i) slopes[i] = slope_of(columns.real[i]);
  const GradientGap why = known_gap != GradientGap::none ? known_gap
                          : finite                       ? GradientGap::none
                                                         : GradientGap::singular;
  if (why != GradientGap::none) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    slopes_a.fill({none, none});
    slopes.fill(none);
  }
  to.parameter[at] = direction.parameter;
  to.material[at] = direction.material;
  to.a[at] = slopes_a;
  std::tie(to.delay_s[at], to.aod_theta_rad[at], to.aod_phi_rad[at], to.aoa_theta_rad[at], to.aoa_phi_rad[at]) =
      std::tuple_cat(slopes);
  to.gap[at] = why;
}

std::vector<bool> chosen_rows(const PathGeometry& geometry, const GradientChoice& choice) {
  if (!choice.paths) return std::vector<bool>(geometry.size(), true);
  std::vector<bool> out(geometry.size());
  for (const uint32_t row : *choice.paths) out.at(row) = true;
  return out;
}

using SixDirections = std::array<PathDirection, tangent::lanes>;
SixDirections six_from(PathParameter first) {
  SixDirections out;
  for (int i = 0; i < tangent::lanes; ++i)
    out[static_cast<size_t>(i)] = {static_cast<PathParameter>(static_cast<int>(first) + i), no_material_number};
  return out;
}

// Calls work(tables, row) for each chosen row, on all cores. Rows that follow each other share their tables.
template <class Work>
void for_each_row(const std::vector<uint32_t>& rows, const PathTables& first_tables, const Work& work) {
  constexpr size_t rows_at_a_time = 64;
  tbb::enumerable_thread_specific<PathTables> all(first_tables);
  tbb::parallel_for(tbb::blocked_range<size_t>(0, rows.size(), rows_at_a_time),
                    [&](const tbb::blocked_range<size_t>& range) {
                      PathTables& tables = all.local();
                      for (size_t i = range.begin(); i < range.end(); ++i) {
                        tables.set_row(rows[i]);
                        work(tables, rows[i]);
                      }
                    });
}

// Makes room for this many entries of each row.
void make_room(ModelGradients& out, const std::vector<uint32_t>& counts) {
  out.first.resize(counts.size() + 1);
  std::inclusive_scan(counts.begin(), counts.end(), out.first.begin() + 1, std::plus<>(), uint64_t{0});
  const size_t count = out.first.back();
  out.parameter.resize(count);
  out.material.resize(count);
  out.a.resize(count);
  for (auto* column : {&out.delay_s, &out.aod_theta_rad, &out.aod_phi_rad, &out.aoa_theta_rad, &out.aoa_phi_rad})
    column->resize(count);
  out.gap.resize(count);
}

}  // namespace

GradientModel::GradientModel(const Scene& scene, const Config& config, std::span<const Scene> models,
                             std::span<const Instance> instances)
    : scene_(scene),
      models_(models),
      instances_(instances.begin(), instances.end()),
      tables_(make_field_tables(scene, config, models, instances)),
      frequency_hz_(config.radio.frequency_hz) {
  if (!tables_.targets.laws.empty())
    throw ConfigError(
        "paths over targets ([[target_model]]) have no derivatives: set trace.target = false, or remove the targets");
}

ModelGradients GradientModel::compute(uint32_t frame, const PathGeometry& geometry, const WorldState& state,
                                      const GradientChoice& choice) const {
  const std::vector<bool> chosen = chosen_rows(geometry, choice);
  const FieldFrame rows = make_field_frame(tables_, scene_, models_, instances_, geometry, state);
  const device::wt_field_world world = rows.world(tables_);
  const ConstantTables constants = constant_tables(tables_);
  ModelGradients out;
  std::vector<uint32_t> wanted;
  for (uint32_t row = 0; row < rows.rows.size(); ++row) {
    out.path.push_back(rows.rows[row] / 2);
    if (chosen[out.path.back()]) wanted.push_back(row);
  }
  out.paths = paths_of(rows, tables_, scene_.origin_m, frame);
  const PathTables tables(tables_, constants, rows, world);
  std::vector<uint32_t> counts(rows.rows.size());
  const uint32_t of_ends = tangent::lanes * (uint32_t{choice.positions} + uint32_t{choice.orientations});
  for (const uint32_t row : wanted) counts[row] = of_ends;
  if (choice.materials)
    for_each_row(wanted, tables, [&](PathTables& path, uint32_t row) {
      counts[row] += static_cast<uint32_t>(path.material_directions().size());
    });
  make_room(out, counts);
  for_each_row(wanted, tables, [&](PathTables& path, uint32_t row) { write_row(out, path, row, choice); });
  return out;
}

void GradientModel::write_row(ModelGradients& out, PathTables& path, uint32_t row, const GradientChoice& choice) const {
  size_t at = out.first[row];
  const auto add = [&](std::span<const PathDirection> directions, GradientGap gap) {
    Tangent delay;
    const tangent::wt_path_field field = path.fields(directions, frequency_hz_, delay);
    const PathColumns columns = columns_of_field(field, delay, tables_.ports);
    check_values(columns, out.paths, row);
    for (size_t lane = 0; lane < directions.size(); ++lane)
      write_entry(out, at++, directions[lane], columns, static_cast<int>(lane),
                  path.is_singular(directions[lane]) ? GradientGap::singular : gap);
  };
  if (choice.materials) {
    const std::span<const PathDirection> directions = path.material_directions();
    for (size_t i = 0; i < directions.size(); i += tangent::lanes)
      add(directions.subspan(i, std::min<size_t>(tangent::lanes, directions.size() - i)), GradientGap::none);
  }
  if (choice.positions) {
    static const SixDirections positions = six_from(PathParameter::tx_x);
    const bool solved = path.solve_vertices();
    add(positions, solved ? gap_of_positions(path.world(), path.path()) : GradientGap::not_solved);
  }
  if (choice.orientations) {
    static const SixDirections turns = six_from(PathParameter::tx_turn_x);
    add(turns, gap_of_turns(path.world(), path.path()));
  }
}

}  // namespace wavetracer
