// SPDX-License-Identifier: Apache-2.0
// Antennas at the ends of paths: element patterns and the ports of an antenna, turned into the global frame.
// host/radio/pattern.hpp and antenna.hpp describe both. Directions have unit length and point away from the antenna.
#ifndef WAVETRACER_DEVICE_ANTENNA_H
#define WAVETRACER_DEVICE_ANTENNA_H
#include "wavetracer/device/field_records.h"
#include "wavetracer/device/transfer.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

typedef struct {
  double theta, phi;  // radians: theta from +z, 0 to pi; phi from +x towards +y, -pi to pi
} wt_angles;

// Components along theta-hat and phi-hat.
typedef struct {
  wt_double2 theta, phi;
} wt_field_pair;

typedef struct {
  wt_field_pair port[2];  // zeros for a port that the antenna does not have
} wt_port_fields;

inline wt_angles wt_angles_of(wt_double3 direction) {
  // Adding 0.0 turns a y of -0 into +0, so phi on the negative x axis is pi and never -pi.
  const double rho = sqrt(direction.x * direction.x + direction.y * direction.y);
  wt_angles out;
  out.theta = wt_atan2(rho, direction.z);
  out.phi = rho == 0.0 ? 0.0 : wt_atan2(direction.y + 0.0, direction.x);
  return out;
}

// The field of a half-wave dipole, cos(pi/2 cos theta) / sin theta, times the root of the directivity 4 / Cin(2 pi)
// (Balanis, Antenna Theory, 4th edition, eq. 4-91). It is computed from the angle to the nearer end of the axis, which
// keeps its digits there.
inline double wt_half_wave_dipole(double theta) {
  const double from_axis = fmin(theta, WT_PI - theta);
  if (from_axis <= 0.0) return 0.0;
  const double half_sine = wt_cos_sin(from_axis / 2.0).y;
  return sqrt(1.6409223769845852) * wt_cos_sin(WT_PI * half_sine * half_sine).y / wt_cos_sin(from_axis).y;
}

// The element pattern of 3GPP TR 38.901, Table 7.3-1.
inline double wt_tr38901(wt_angles angles) {
  const double degrees = 180.0 / WT_PI, down = (angles.theta * degrees - 90.0) / 65.0,
               across = angles.phi * degrees / 65.0;
  const double loss_db = fmin(12.0 * down * down, 30.0) + fmin(12.0 * across * across, 30.0);
  return wt_exp((8.0 - fmin(loss_db, 30.0)) * 0.11512925464970228);  // ln(10) / 20
}

inline wt_field_pair wt_sample(const WT_GLOBAL double* samples, wt_uint at) {
  const WT_GLOBAL double* s = samples + 4 * (wt_ulong)at;
  wt_field_pair out;
  out.theta = WT_DOUBLE2(s[0], s[1]);
  out.phi = WT_DOUBLE2(s[2], s[3]);
  return out;
}

inline wt_field_pair wt_mix(wt_field_pair a, wt_field_pair b, double t) {
  wt_field_pair out;
  out.theta = a.theta * (1.0 - t) + b.theta * t;
  out.phi = a.phi * (1.0 - t) + b.phi * t;
  return out;
}

// Interpolates bilinearly between the four samples around a direction.
inline wt_field_pair wt_grid_pattern(const WT_GLOBAL wt_antenna* antenna, const WT_GLOBAL double* samples,
                                     wt_angles angles) {
  const double micro_degrees = 180e6 / WT_PI, count = (double)antenna->columns;
  const double row = angles.theta * micro_degrees / antenna->theta_step;
  const double column = (angles.phi * micro_degrees - antenna->first_phi) / antenna->phi_step;
  const double below = fmin(fmax(floor(row), 0.0), (double)(antenna->rows - 2));
  const double before = floor(column), down = fmin(fmax(row - below, 0.0), 1.0), across = column - before;
  const wt_uint j = (wt_uint)(before - count * floor(before / count)) % antenna->columns;
  const wt_uint next = (j + 1) % antenna->columns;
  const wt_uint upper = antenna->first_sample + (wt_uint)below * antenna->columns, lower = upper + antenna->columns;
  return wt_mix(wt_mix(wt_sample(samples, upper + j), wt_sample(samples, upper + next), across),
                wt_mix(wt_sample(samples, lower + j), wt_sample(samples, lower + next), across), down);
}

// The pattern for a direction in the antenna's own frame.
inline wt_field_pair wt_pattern(const WT_GLOBAL wt_antenna* antenna, const WT_GLOBAL double* samples,
                                wt_double3 direction) {
  wt_field_pair out;
  out.theta = wt_real(1.0);
  out.phi = wt_real(0.0);
  if (antenna->pattern == WT_PATTERN_ISOTROPIC) return out;
  const wt_angles angles = wt_angles_of(direction);
  if (antenna->pattern == WT_PATTERN_GRID) return wt_grid_pattern(antenna, samples, angles);
  if (antenna->pattern == WT_PATTERN_SHORT_DIPOLE)
    out.theta.x = sqrt(1.5) * wt_cos_sin(angles.theta).y;
  else
    out.theta.x = antenna->pattern == WT_PATTERN_TR38901 ? wt_tr38901(angles) : wt_half_wave_dipole(angles.theta);
  return out;
}

// The field of each port along the vectors of basis, which is wt_spherical_basis(direction). Its squared length is the
// gain over isotropic. By reciprocity it serves sending and receiving alike. r: the rotation, as in wt_field_end.
inline wt_port_fields wt_antenna_fields(const WT_GLOBAL wt_antenna* antenna, const WT_GLOBAL double* samples,
                                        const WT_GLOBAL double* r, wt_double3 direction, wt_basis basis) {
  const wt_double3 own_direction = WT_DOUBLE3(r[0] * direction.x + r[3] * direction.y + r[6] * direction.z,
                                              r[1] * direction.x + r[4] * direction.y + r[7] * direction.z,
                                              r[2] * direction.x + r[5] * direction.y + r[8] * direction.z);
  const wt_field_pair own = wt_pattern(antenna, samples, own_direction);
  const wt_basis from = wt_spherical_basis(own_direction);
  const wt_double3 theta = WT_DOUBLE3(wt_dot3(wt_vector(r), from.first), wt_dot3(wt_vector(r + 3), from.first),
                                      wt_dot3(wt_vector(r + 6), from.first));
  const wt_double3 phi = WT_DOUBLE3(wt_dot3(wt_vector(r), from.second), wt_dot3(wt_vector(r + 3), from.second),
                                    wt_dot3(wt_vector(r + 6), from.second));
  const double theta_theta = wt_dot3(theta, basis.first), phi_theta = wt_dot3(phi, basis.first);
  const double theta_phi = wt_dot3(theta, basis.second), phi_phi = wt_dot3(phi, basis.second);
  wt_port_fields out;
  for (wt_uint port = 0; port < 2; ++port) {
    const int has = port < antenna->ports;
    const double cosine = has ? antenna->slant[port][0] : 0.0, sine = has ? antenna->slant[port][1] : 0.0;
    const wt_double2 along_theta = own.theta * cosine - own.phi * sine, along_phi = own.theta * sine + own.phi * cosine;
    out.port[port].theta = along_theta * theta_theta + along_phi * phi_theta;
    out.port[port].phi = along_theta * theta_phi + along_phi * phi_phi;
  }
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
