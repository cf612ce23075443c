// SPDX-License-Identifier: Apache-2.0
// A kernel that only tests run: the integral and the field of facets (wavetracer/device/facet.h), whose bits a host
// compares with its own. Facet i has 18 numbers in `in`: phases of three corners, the directions in, out and of the
// normal, both reflection coefficients, the area and the wavelength; and ten in `out`: the amplitude and the matrix.
#include "wavetracer/device/facet.h"

kernel void facets(const global double* in, uint count, global double* out) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const global double* x = in + 18 * i;
  global double* y = out + 10 * i;
  const wt_double2 integral = wt_triangle_mean(x[0], x[1], x[2]) * x[16];
  const wt_double2 amplitude = wt_facet_amplitude(integral, x[17]);
  const wt_double3 k_in = wt_vector(x + 3), k_out = wt_vector(x + 6), normal = wt_vector(x + 9);
  const wt_matrix m = wt_facet_matrix(k_in, k_out, normal, WT_DOUBLE2(x[12], x[13]), WT_DOUBLE2(x[14], x[15]),
                                      wt_spherical_basis(-k_out));
  y[0] = amplitude.x;
  y[1] = amplitude.y;
  for (int k = 0; k < 4; ++k) {
    y[2 + 2 * k] = m.m[k].x;
    y[3 + 2 * k] = m.m[k].y;
  }
}
