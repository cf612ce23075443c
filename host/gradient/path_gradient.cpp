// SPDX-License-Identifier: Apache-2.0
#include "gradient/path_gradient.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "gradient/path_gaps.hpp"
#include "gradient/path_tables.hpp"
#include "radio/field_frame.hpp"

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

// The entries of one path.
struct PathEntries {
  std::vector<PathDirection> directions;
  std::vector<std::array<std::complex<double>, 4>> a;
  std::vector<std::array<double, 5>> real;
  std::vector<GradientGap> gap;

  void add(const PathDirection& direction, const PathColumns& columns, size_t lane, GradientGap known_gap) {
    std::array<std::complex<double>, 4> slopes_a;
    std::array<double, 5> slopes;
    for (size_t i = 0; i < 4; ++i) slopes_a[i] = {columns.a[i].first.d[lane], columns.a[i].second.d[lane]};
    for (size_t i = 0; i < 5; ++i) slopes[i] = columns.real[i].d[lane];
    const bool finite =
        std::ranges::all_of(slopes, [](double d) { return std::isfinite(d); }) &&
        std::ranges::all_of(slopes_a, [](const auto& d) { return std::isfinite(d.real()) && std::isfinite(d.imag()); });
    const GradientGap why = known_gap != GradientGap::none ? known_gap
                            : finite                       ? GradientGap::none
                                                           : GradientGap::singular;
    if (why != GradientGap::none) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      slopes_a.fill({none, none});
      slopes.fill(none);
    }
    directions.push_back(direction);
    a.push_back(slopes_a);
    real.push_back(slopes);
    gap.push_back(why);
  }
};

std::vector<bool> chosen_rows(const PathGeometry& geometry, const GradientChoice& choice) {
  if (!choice.paths) return std::vector<bool>(geometry.size(), true);
  std::vector<bool> out(geometry.size());
  for (const uint32_t row : *choice.paths) out.at(row) = true;
  return out;
}

std::vector<PathDirection> six_from(PathParameter first) {
  std::vector<PathDirection> out;
  for (int i = 0; i < tangent::lanes; ++i)
    out.push_back({static_cast<PathParameter>(static_cast<int>(first) + i), no_material_number});
  return out;
}

void append(ModelGradients& to, const PathEntries& entries) {
  for (size_t i = 0; i < entries.directions.size(); ++i) {
    to.parameter.push_back(entries.directions[i].parameter);
    to.material.push_back(entries.directions[i].material);
    to.a.push_back(entries.a[i]);
    const auto& [delay_s, aod_theta, aod_phi, aoa_theta, aoa_phi] = entries.real[i];
    to.delay_s.push_back(delay_s);
    to.aod_theta_rad.push_back(aod_theta);
    to.aod_phi_rad.push_back(aod_phi);
    to.aoa_theta_rad.push_back(aoa_theta);
    to.aoa_phi_rad.push_back(aoa_phi);
    to.gap.push_back(entries.gap[i]);
  }
  to.first.push_back(to.parameter.size());
}

}  // namespace

GradientModel::GradientModel(const Scene& scene, const Config& config, std::span<const Scene> models,
                             std::span<const Instance> instances)
    : scene_(scene),
      models_(models),
      instances_(instances.begin(), instances.end()),
      tables_(make_field_tables(scene, config, models, instances)),
      frequency_hz_(config.radio.frequency_hz) {}

ModelGradients GradientModel::compute(uint32_t frame, const PathGeometry& geometry, const WorldState& state,
                                      const GradientChoice& choice) const {
  const std::vector<bool> chosen = chosen_rows(geometry, choice);
  const FieldFrame rows = make_field_frame(tables_, scene_, models_, instances_, geometry, state);
  const device::wt_field_world world = rows.world(tables_);
  const ConstantTables constants = constant_tables(tables_);
  ModelGradients out;
  for (const uint32_t row : rows.rows) out.path.push_back(row / 2);
  out.paths = paths_of(rows, tables_, scene_.origin_m, frame);
  std::vector<PathEntries> entries(rows.rows.size());
  tbb::parallel_for(size_t{0}, entries.size(), [&](size_t row) {
    if (!chosen[out.path[row]]) return;
    PathTables path(tables_, constants, rows, world, static_cast<uint32_t>(row));
    const auto add = [&](std::span<const PathDirection> directions, GradientGap gap) {
      Tangent delay;
      const tangent::wt_path_field field = path.fields(directions, frequency_hz_, delay);
      const PathColumns columns = columns_of_field(field, delay, tables_.ports);
      check_values(columns, out.paths, row);
      for (size_t lane = 0; lane < directions.size(); ++lane)
        entries[row].add(directions[lane], columns, lane,
                         path.is_singular(directions[lane]) ? GradientGap::singular : gap);
    };
    if (choice.materials) {
      const std::vector<PathDirection> directions = path.material_directions();
      for (size_t i = 0; i < directions.size(); i += tangent::lanes)
        add(std::span(directions).subspan(i, std::min<size_t>(tangent::lanes, directions.size() - i)),
            GradientGap::none);
    }
    if (choice.positions)
      add(six_from(PathParameter::tx_x),
          path.is_solved() ? gap_of_positions(world, path.path()) : GradientGap::not_solved);
    if (choice.orientations) add(six_from(PathParameter::tx_turn_x), gap_of_turns(world, path.path()));
  });
  for (const PathEntries& of_path : entries) append(out, of_path);
  return out;
}

}  // namespace wavetracer
