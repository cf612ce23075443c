// SPDX-License-Identifier: Apache-2.0
// The transverse field of a wave along a path: a 2 x 2 matrix in a basis that travels with the wave.
// Plane waves at plane surfaces; spreading and antennas are left to the caller. Directions are of unit length.
#ifndef WAVETRACER_DEVICE_TRANSFER_H
#define WAVETRACER_DEVICE_TRANSFER_H
#include "wavetracer/device/slab.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Two unit vectors, normal to each other and to a direction of travel.
typedef struct {
  wt_double3 first, second;
} wt_basis;

// Columns of the matrix belong to the basis at the start, rows to the basis `rows`.
typedef struct {
  wt_matrix matrix;
  wt_basis rows;
} wt_transfer;

// The basis theta-hat and phi-hat; at the poles, where phi is free, phi is 0.
inline wt_basis wt_spherical_basis(wt_double3 direction) {
  const double rho = sqrt(direction.x * direction.x + direction.y * direction.y);
  const double cosine = rho == 0.0 ? 1.0 : direction.x / rho, sine = rho == 0.0 ? 0.0 : direction.y / rho;
  wt_basis out;
  out.first = WT_DOUBLE3(direction.z * cosine, direction.z * sine, -rho);
  out.second = WT_DOUBLE3(-sine, cosine, 0.0);
  return out;
}

inline wt_matrix wt_turned(wt_matrix m, wt_basis from, wt_basis to) {
  const double c00 = wt_dot3(to.first, from.first), c01 = wt_dot3(to.first, from.second);
  const double c10 = wt_dot3(to.second, from.first), c11 = wt_dot3(to.second, from.second);
  wt_matrix out;
  out.m[0] = m.m[0] * c00 + m.m[2] * c01;
  out.m[1] = m.m[1] * c00 + m.m[3] * c01;
  out.m[2] = m.m[0] * c10 + m.m[2] * c11;
  out.m[3] = m.m[1] * c10 + m.m[3] * c11;
  return out;
}

inline wt_transfer wt_transfer_from(wt_basis departure) {
  wt_transfer out;
  out.matrix = wt_diagonal(wt_real(1.0), wt_real(1.0));
  out.rows = departure;
  return out;
}

// The unit normal of the plane of incidence. At normal incidence there is no such plane, TE and TM are the same and any
// direction in the surface serves. Below 1e-8 the cross product has lost half its digits, and TE and TM differ by less.
inline wt_double3 wt_incidence_normal(wt_double3 k, wt_double3 normal) {
  const wt_double3 across = wt_cross3(k, normal);
  const double sine = wt_length3(across);
  if (sine > 1e-8) return across / sine;
  return wt_normalized(wt_cross3(k, fabs(k.x) < 0.5 ? WT_DOUBLE3(1.0, 0.0, 0.0) : WT_DOUBLE3(0.0, 1.0, 0.0)));
}

// The polarizations TE and TM of a wave along k at a surface.
inline wt_basis wt_polarizations(wt_double3 k, wt_double3 normal) {
  wt_basis out;
  out.first = wt_incidence_normal(k, normal);
  out.second = wt_cross3(out.first, k);
  return out;
}

// The wave meets an edge or a rough surface: its field in components along from is multiplied by the matrix and goes on
// in components along to.
inline void wt_map(wt_transfer* transfer, wt_basis from, wt_basis to, wt_matrix matrix) {
  transfer->matrix = wt_matrix_product(matrix, wt_turned(transfer->matrix, transfer->rows, from));
  transfer->rows = to;
}

// The wave travels along k_in, meets a surface and goes on along k_out: its field normal to the plane of incidence (TE)
// and in that plane (TM) is multiplied by te and tm, with the signs of slab.h.
inline void wt_meet(wt_transfer* transfer, wt_double3 k_in, wt_double3 k_out, wt_double3 normal, wt_double2 te,
                    wt_double2 tm) {
  const wt_basis from = wt_polarizations(k_in, normal);
  wt_matrix m = wt_turned(transfer->matrix, transfer->rows, from);
  for (int column = 0; column < 2; ++column) {
    m.m[column] = wt_times(m.m[column], te);
    m.m[2 + column] = wt_times(m.m[2 + column], tm);
  }
  transfer->matrix = m;
  transfer->rows.first = from.first;
  transfer->rows.second = wt_cross3(from.first, k_out);
}

// The matrix with its rows in the basis of the arrival.
inline wt_matrix wt_seen_in(const wt_transfer* transfer, wt_basis arrival) {
  return wt_turned(transfer->matrix, transfer->rows, arrival);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
