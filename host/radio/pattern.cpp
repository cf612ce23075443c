// The closed-form element patterns.
// Assumes lossless antennas: mean gain over the sphere is 1, except for TR 38.901, whose pattern is a fit.
#include "radio/pattern.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavetracer {
namespace {

using std::numbers::pi;

// Directivity of a thin half-wave dipole: 4 / Cin(2 pi) (Balanis, Antenna Theory, 4th edition, eq. 4-91).
constexpr double half_wave_directivity = 1.6409223769845852;

}  // namespace

FieldPair isotropic_pattern(const Angles&) { return {1.0, 0.0}; }

FieldPair short_dipole_pattern(const Angles& angles) { return {std::sqrt(1.5) * std::sin(angles.theta_rad), 0.0}; }

FieldPair half_wave_dipole_pattern(const Angles& angles) {
  // cos(pi/2 cos theta) / sin theta, written with the angle from the nearer end of the axis to keep its digits there.
  const double from_axis = std::min(angles.theta_rad, pi - angles.theta_rad);
  if (from_axis <= 0) return {0.0, 0.0};
  const double half_sine = std::sin(from_axis / 2);
  return {std::sqrt(half_wave_directivity) * std::sin(pi * half_sine * half_sine) / std::sin(from_axis), 0.0};
}

FieldPair tr38901_pattern(const Angles& angles) {
  constexpr double gain_dbi = 8, floor_db = 30, beamwidth_deg = 65;
  constexpr double degrees = 180 / pi;
  const auto cut_db = [&](double off_boresight_deg) {
    return std::min(12 * std::pow(off_boresight_deg / beamwidth_deg, 2), floor_db);
  };
  const double loss_db = cut_db(angles.theta_rad * degrees - 90) + cut_db(angles.phi_rad * degrees);
  return {std::pow(10.0, (gain_dbi - std::min(loss_db, floor_db)) / 20), 0.0};
}

}  // namespace wavetracer
