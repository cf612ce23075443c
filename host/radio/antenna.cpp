// The antenna of a radio end: pattern, slant, orientation.
// Assumes unit directions; the pattern is always evaluated in the antenna's own frame.
#include "radio/antenna.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <glm/matrix.hpp>
#include <numbers>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

Pattern pattern_of(const RadioEnd& end) {
  constexpr std::array named = {isotropic_pattern, short_dipole_pattern, half_wave_dipole_pattern, tr38901_pattern};
  static_assert(named.size() == NamedAntenna::words.size());
  if (const auto antenna = NamedAntenna::parse(end.antenna)) return named[antenna->index()];
  std::error_code unnameable;
  if (std::filesystem::is_regular_file(end.antenna, unnameable)) return load_pattern(end.antenna);
  throw ConfigError(
      fmt::format("\"{}\": antenna = \"{}\" is neither isotropic, short-dipole, dipole or tr38901 nor a "
                  "pattern file that exists",
                  end.name, end.antenna));
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
  const glm::dmat3 about_z{std::cos(yaw), std::sin(yaw), 0, -std::sin(yaw), std::cos(yaw), 0, 0, 0, 1};  // by columns
  const glm::dmat3 about_y{std::cos(pitch), 0, -std::sin(pitch), 0, 1, 0, std::sin(pitch), 0, std::cos(pitch)};
  const glm::dmat3 about_x{1, 0, 0, 0, std::cos(roll), std::sin(roll), 0, -std::sin(roll), std::cos(roll)};
  return about_z * about_y * about_x;
}

Antenna::Antenna(Pattern pattern, const std::vector<double>& slants_rad, const glm::dmat3& rotation)
    : pattern_(std::move(pattern)), to_global_(rotation) {
  const auto* function = pattern_.target<FieldPair (*)(const Angles&)>();
  isotropic_ = function && *function == isotropic_pattern;
  for (const double slant : slants_rad) slants_.push_back({std::cos(slant), std::sin(slant)});
}

PortFields Antenna::fields(const glm::dvec3& direction, const SphericalBasis& basis, const glm::dmat3& rotation) const {
  const glm::dvec3 local = glm::transpose(rotation) * direction;
  const FieldPair own = pattern_(isotropic_ ? Angles{0, 0} : angles_of(local));
  const SphericalBasis from = basis_of(local);
  const glm::dvec3 theta = rotation * from.theta, phi = rotation * from.phi;
  const double theta_theta = glm::dot(theta, basis.theta), phi_theta = glm::dot(phi, basis.theta);
  const double theta_phi = glm::dot(theta, basis.phi), phi_phi = glm::dot(phi, basis.phi);
  PortFields out{};
  for (uint32_t port = 0; port < ports(); ++port) {
    const auto [cosine, sine] = slants_[port];
    const std::complex<double> along_theta = cosine * own.theta - sine * own.phi;
    const std::complex<double> along_phi = sine * own.theta + cosine * own.phi;
    out[port] = {along_theta * theta_theta + along_phi * phi_theta, along_theta * theta_phi + along_phi * phi_phi};
  }
  return out;
}

Antenna make_antenna(const RadioEnd& end) {
  return Antenna(pattern_of(end), slants_of(end), rotation_of(end.orientation_deg));
}

}  // namespace wavetracer
