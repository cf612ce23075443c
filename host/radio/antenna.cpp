// SPDX-License-Identifier: Apache-2.0
// The antenna of a radio end: pattern, slant, orientation.
// The host computes cosines and sines of slants and orientations once, and sends them to every device.
#include "radio/antenna.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/input_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

// The number of a named pattern, or WT_PATTERN_GRID and the samples of the file.
std::pair<uint32_t, PatternGrid> pattern_of(const RadioEnd& end) {
  static_assert(NamedAntenna::words.size() == WT_PATTERN_GRID);
  if (const auto antenna = NamedAntenna::parse(end.antenna)) return {static_cast<uint32_t>(antenna->index()), {}};
  std::error_code unnameable;
  if (std::filesystem::is_regular_file(end.antenna, unnameable)) return {WT_PATTERN_GRID, load_pattern(end.antenna)};
  throw ConfigError(
      fmt::format("\"{}\": antenna = \"{}\" is neither isotropic, short-dipole, dipole or tr38901 nor a "
                  "pattern file that exists{}",
                  end.name, end.antenna, backslash_hint(end.antenna)));
}

std::vector<double> slants_of(const RadioEnd& end) {
  constexpr double quarter = std::numbers::pi / 2, eighth = std::numbers::pi / 4;
  if (end.polarization == "V") return {0};
  if (end.polarization == "H") return {quarter};
  if (end.polarization == "VH") return {0, quarter};
  return {eighth, -eighth};  // cross
}

}  // namespace

glm::dmat3 rotation_of(const std::array<double, 3>& orientation_deg) {
  const double yaw = orientation_deg[0] * radians_per_degree, pitch = orientation_deg[1] * radians_per_degree,
               roll = orientation_deg[2] * radians_per_degree;
  const glm::dmat3 about_z{std::cos(yaw), std::sin(yaw), 0, -std::sin(yaw), std::cos(yaw), 0, 0, 0, 1};  // columns
  const glm::dmat3 about_y{std::cos(pitch), 0, -std::sin(pitch), 0, 1, 0, std::sin(pitch), 0, std::cos(pitch)};
  const glm::dmat3 about_x{1, 0, 0, 0, std::cos(roll), std::sin(roll), 0, -std::sin(roll), std::cos(roll)};
  return about_z * about_y * about_x;
}

Antenna::Antenna(uint32_t pattern, const PatternGrid& grid, const std::vector<double>& slants_rad,
                 const glm::dmat3& rotation)
    : samples_(grid.samples), to_global_(rotation) {
  record_.pattern = pattern;
  record_.ports = static_cast<uint32_t>(slants_rad.size());
  record_.rows = grid.rows;
  record_.columns = grid.columns;
  record_.theta_step = grid.theta_step;
  record_.phi_step = grid.phi_step;
  record_.first_phi = grid.first_phi;
  for (size_t port = 0; port < slants_rad.size(); ++port) {
    record_.slant[port][0] = std::cos(slants_rad[port]);
    record_.slant[port][1] = std::sin(slants_rad[port]);
  }
}

FieldPair Antenna::field(uint32_t port, const glm::dvec3& direction) const {
  double rotation[9];
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation[3 * row + column] = to_global_[column][row];
  const auto fields =
      device::wt_antenna_fields(&record_, samples_.data(), rotation, direction, device::wt_spherical_basis(direction));
  const device::wt_field_pair& pair = fields.port[port];
  return {{pair.theta.x, pair.theta.y}, {pair.phi.x, pair.phi.y}};
}

Antenna make_antenna(const RadioEnd& end) {
  const auto [pattern, grid] = pattern_of(end);
  return Antenna(pattern, grid, slants_of(end), rotation_of(end.orientation_deg));
}

}  // namespace wavetracer
