// SPDX-License-Identifier: Apache-2.0
#include "gradient/frame_gradient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <complex>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/digits.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

void check_rows(const GradientChoice& choice, size_t paths) {
  if (!choice.paths) return;
  for (const uint32_t row : *choice.paths)
    if (row >= paths)
      throw ConfigError(
          fmt::format("there is no path {}, only {} counted from 0, so it has no derivatives", row, grouped(paths)));
}

void add_entry(PathGradients& to, const ModelGradients& from, size_t entry, uint32_t material) {
  to.parameter.push_back(from.parameter[entry]);
  to.material.push_back(material);
  to.a.push_back(from.a[entry]);
  to.delay_s.push_back(from.delay_s[entry]);
  to.aod_theta_rad.push_back(from.aod_theta_rad[entry]);
  to.aod_phi_rad.push_back(from.aod_phi_rad[entry]);
  to.aoa_theta_rad.push_back(from.aoa_theta_rad[entry]);
  to.aoa_phi_rad.push_back(from.aoa_phi_rad[entry]);
  to.gap.push_back(from.gap[entry]);
}

// Adds the slopes of another record of the same material. A material moves no path, so delays and angles stay.
void add_slopes(PathGradients& to, size_t at, const ModelGradients& from, size_t entry) {
  for (size_t port = 0; port < 4; ++port) to.a[at][port] += from.a[entry][port];
  to.gap[at] = std::max(to.gap[at], from.gap[entry]);
}

// Rounding of file coordinates changes coefficients by much less than this share, unless they jump.
constexpr double most_change = 1e-4;

// Are the coefficients that are differentiated those of the frame?
bool is_same(const std::array<std::complex<double>, 4>& a, const std::array<std::complex<double>, 4>& of_frame) {
  double apart = 0, size = 0;
  for (size_t port = 0; port < 4; ++port) {
    apart = std::max(apart, std::abs(a[port] - of_frame[port]));
    size = std::max(size, std::abs(of_frame[port]));
  }
  return apart <= most_change * size;
}

// Leaves no derivative of a path.
void leave_out(PathGradients& of, size_t first) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (size_t entry = first; entry < of.size(); ++entry) {
    of.a[entry].fill({none, none});
    for (auto* column : {&of.delay_s, &of.aod_theta_rad, &of.aod_phi_rad, &of.aoa_theta_rad, &of.aoa_phi_rad})
      (*column)[entry] = none;
    of.gap[entry] = GradientGap::jump;
  }
}

// The names of records, as PathGradients::materials says.
class RecordNames {
 public:
  explicit RecordNames(const FieldTables& tables) : tables_(tables) {
    for (std::vector<uint32_t>& of : known_) of.assign(tables.names.size(), unknown);
  }

  // Returns the index of the name.
  uint32_t number(uint32_t record, PathParameter parameter) {
    if (record == no_material_number) return no_material_number;
    const bool is_thickness = parameter == PathParameter::thickness;
    uint32_t& number = known_[is_thickness][record];
    if (number == unknown) number = number_of(name_of(record, is_thickness));
    return number;
  }

  std::vector<std::string> names;

 private:
  static constexpr uint32_t unknown = no_material_number;

  uint32_t number_of(const std::string& name) {
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return static_cast<uint32_t>(found - names.begin());
    names.push_back(name);
    return static_cast<uint32_t>(names.size() - 1);
  }

  bool is_layer(uint32_t record) const { return !tables_.walls[record].empty() && !tables_.names[record].empty(); }

  // Layers of a wall follow each other, in the order of the wall.
  std::string name_of(uint32_t record, bool is_thickness) const {
    if (tables_.names[record].empty()) return tables_.walls[record];
    if (!is_layer(record) || !is_thickness) return tables_.names[record];
    uint32_t layer = 0;
    while (is_layer(record - layer - 1)) ++layer;
    return fmt::format("{}.layers[{}]", tables_.walls[record], layer);
  }

  const FieldTables& tables_;
  std::array<std::vector<uint32_t>, 2> known_;  // the index of each record, for thickness the second one
};

// Adds the entries of a row of `rows`; the records of one material become one entry.
void add_row(PathGradients& to, const ModelGradients& rows, size_t row, RecordNames& materials) {
  const size_t first = to.size();
  for (uint64_t entry = rows.first[row]; entry < rows.first[row + 1]; ++entry) {
    const uint32_t material = materials.number(rows.material[entry], rows.parameter[entry]);
    size_t at = first;
    while (at < to.size() && (to.parameter[at] != rows.parameter[entry] || to.material[at] != material)) ++at;
    if (at == to.size())
      add_entry(to, rows, entry, material);
    else
      add_slopes(to, at, rows, entry);
  }
}

}  // namespace

FrameGradient::FrameGradient(const Scene& scene, const Config& config, std::span<const Scene> models,
                             std::span<const Instance> instances)
    : model_(scene, config, models, instances), geometry_(scene, config, models, instances) {}

PathGradients FrameGradient::operator()(const FrameResult& frame, const GradientChoice& choice) {
  check_rows(choice, frame.paths.size());
  const ModelGradients rows = model_.compute(frame.frame, geometry_(frame.paths, frame.world), frame.world, choice);
  std::vector<size_t> row_of(frame.paths.size(), rows.path.size());
  for (size_t row = 0; row < rows.path.size(); ++row) row_of[rows.path[row]] = row;
  RecordNames materials(model_.tables());
  PathGradients out;
  for (size_t path = 0; path < row_of.size(); ++path) {
    if (row_of[path] == rows.path.size())
      throw RuntimeError(
          fmt::format("path {} is not one of those that its points give: the frame is of another simulation", path));
    add_row(out, rows, row_of[path], materials);
    if (!is_same(rows.paths.a[row_of[path]], frame.paths.a[path])) leave_out(out, out.first.back());
    out.first.push_back(out.size());
  }
  out.materials = std::move(materials.names);
  return out;
}

}  // namespace wavetracer
