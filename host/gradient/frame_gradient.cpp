// SPDX-License-Identifier: Apache-2.0
#include "gradient/frame_gradient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <complex>
#include <cstdint>
#include <limits>
#include <map>
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
  explicit RecordNames(const MaterialTable& materials) : materials_(materials) {}

  // Returns the index of the name.
  uint32_t number(uint32_t record, PathParameter parameter) {
    if (record == no_material_number) return no_material_number;
    const std::string name = name_of(record, parameter);
    const auto found = std::ranges::find(names, name);
    if (found != names.end()) return static_cast<uint32_t>(found - names.begin());
    names.push_back(name);
    return static_cast<uint32_t>(names.size() - 1);
  }

  std::vector<std::string> names;

 private:
  bool is_layer(uint32_t record) const {
    return !materials_.walls[record].empty() && !materials_.names[record].empty();
  }

  // Layers of a wall follow each other, in the order of the wall.
  std::string name_of(uint32_t record, PathParameter parameter) const {
    if (materials_.names[record].empty()) return materials_.walls[record];
    if (!is_layer(record) || parameter != PathParameter::thickness) return materials_.names[record];
    uint32_t layer = 0;
    while (is_layer(record - layer - 1)) ++layer;
    return fmt::format("{}.layers[{}]", materials_.walls[record], layer);
  }

  const MaterialTable& materials_;
};

}  // namespace

FrameGradient::FrameGradient(const Scene& scene, const Config& config, std::span<const Scene> models,
                             std::span<const Instance> instances)
    : model_(scene, config, models, instances),
      geometry_(scene, config, models, instances),
      materials_(make_material_table(scene, models, instances, config.radio.frequency_hz)) {}

PathGradients FrameGradient::operator()(const FrameResult& frame, const GradientChoice& choice) {
  check_rows(choice, frame.paths.size());
  const ModelGradients rows = model_.compute(frame.frame, geometry_(frame.paths, frame.world), frame.world, choice);
  std::vector<size_t> row_of(frame.paths.size(), rows.path.size());
  for (size_t row = 0; row < rows.path.size(); ++row) row_of[rows.path[row]] = row;
  RecordNames materials(materials_);
  PathGradients out;
  for (size_t path = 0; path < row_of.size(); ++path) {
    if (row_of[path] == rows.path.size())
      throw RuntimeError(
          fmt::format("path {} is not one of those that its points give: the frame is of another simulation", path));
    std::map<std::pair<PathParameter, uint32_t>, size_t> known;
    for (uint64_t entry = rows.first[row_of[path]]; entry < rows.first[row_of[path] + 1]; ++entry) {
      const uint32_t material = materials.number(rows.material[entry], rows.parameter[entry]);
      const auto [at, added] = known.try_emplace({rows.parameter[entry], material}, out.size());
      if (added)
        add_entry(out, rows, entry, material);
      else
        add_slopes(out, at->second, rows, entry);
    }
    if (!is_same(rows.paths.a[row_of[path]], frame.paths.a[path])) leave_out(out, out.first.back());
    out.first.push_back(out.size());
  }
  out.materials = std::move(materials.names);
  return out;
}

}  // namespace wavetracer
