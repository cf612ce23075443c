// SPDX-License-Identifier: Apache-2.0
// Scattering of a flat facet by physical optics: tangential fields on its lit side are those of a plane wave and its
// reflection at an endless plane, those on its dark side are zero, and both radiate into free space. See docs/radar.md.
// Time convention exp(+j 2 pi f t), as in slab.h. Lengths are metres, directions of unit length.
#ifndef WAVETRACER_DEVICE_FACET_H
#define WAVETRACER_DEVICE_FACET_H
#include "wavetracer/device/transfer.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The mean of exp(j phase) over a segment on which the phase is linear, from a to b.
inline wt_double2 wt_segment_mean(double a, double b) {
  const double turn = 0.5 * (b - a);
  const double sinc = fabs(turn) < 1e-5 ? 1.0 - turn * turn / 6.0 : wt_cos_sin(turn).y / turn;
  return wt_cos_sin(0.5 * (a + b)) * sinc;
}

// Phases of a triangle are spread less than this: the series below has then all digits.
#define WT_SMALL_SPREAD 1.0

// The same over a triangle, with a phase of sum zero at its corners. With h(n) the sum of all products of n of the
// phases, in which each may occur again, the mean is 2 sum of j^n h(n) / (n + 2)!.
inline wt_double2 wt_small_triangle_mean(double a, double b, double c) {
  const double pairs = a * b + b * c + c * a, product = a * b * c;
  double h[3] = {1.0, 0.0, -pairs};  // h(n - 2), h(n - 1), h(n)
  wt_double2 sum = WT_DOUBLE2(1.0, 0.0);
  double factor = 1.0 / 3.0;  // 2 / (n + 2)!
  for (int n = 2; n <= 18; ++n) {
    factor = factor / (double)(n + 2);
    const double term = factor * h[2];
    if (n & 1)
      sum.y += n & 2 ? -term : term;
    else
      sum.x += n & 2 ? -term : term;
    const double next = product * h[0] - pairs * h[1];
    h[0] = h[1];
    h[1] = h[2];
    h[2] = next;
  }
  return sum;
}

// The mean of exp(j phase) over a triangle on which the phase is linear, from the phases at its corners: the second
// divided difference of the exponential (Hermite and Genocchi). That is Gordon's integral (W. B. Gordon, IEEE Trans.
// Antennas Propag. 23(4), 1975) in a form that loses no digits where the phase is stationary, along an edge or in all
// of the triangle: the difference that it divides by is the largest, and small ones go through the series.
inline wt_double2 wt_triangle_mean(double a, double b, double c) {
  const double middle = (a + b + c) / 3.0;
  const double low = fmin(fmin(a, b), c) - middle, high = fmax(fmax(a, b), c) - middle;
  const double between = -(low + high);
  wt_double2 mean;
  if (high - low < WT_SMALL_SPREAD) {
    mean = wt_small_triangle_mean(low, between, high);
  } else {
    const wt_double2 difference = wt_segment_mean(low, between) - wt_segment_mean(between, high);
    mean = WT_DOUBLE2(-difference.y, difference.x) * (2.0 / (high - low));
  }
  return wt_times(wt_cos_sin(middle), mean);
}

// Returns the field that tangential fields of a wave with electric field e along k send along k_out.
inline wt_double3 wt_radiated(wt_double3 e, wt_double3 k, wt_double3 k_out, wt_double3 normal) {
  const wt_double3 current = wt_cross3(normal, wt_cross3(k, e));
  return wt_cross3(k_out, wt_cross3(k_out, current) - wt_cross3(normal, e));
}

// The field that a unit area with stationary phase sends along k_out, in components along `to`, of a unit wave along
// k_in. Columns belong to wt_polarizations(k_in, normal). normal: on the lit side, so its product with k_in is
// negative; te, tm: reflection coefficients at this incidence, with the signs of slab.h (a perfect conductor: -1, +1).
// Times wt_facet_amplitude, and divided by the distances on both sides, it is the field of the facet.
inline wt_matrix wt_facet_matrix(wt_double3 k_in, wt_double3 k_out, wt_double3 normal, wt_double2 te, wt_double2 tm,
                                 wt_basis to) {
  const wt_basis from = wt_polarizations(k_in, normal);
  const wt_double3 k_mirrored = wt_mirrored(k_in, normal);
  const wt_double3 mirrored_tm = wt_cross3(from.first, k_mirrored);
  const wt_double3 sent_te = wt_radiated(from.first, k_in, k_out, normal);
  const wt_double3 sent_tm = wt_radiated(from.second, k_in, k_out, normal);
  const wt_double3 back_te = wt_radiated(from.first, k_mirrored, k_out, normal);
  const wt_double3 back_tm = wt_radiated(mirrored_tm, k_mirrored, k_out, normal);
  wt_matrix out;
  out.m[0] = wt_real(wt_dot3(to.first, sent_te)) + te * wt_dot3(to.first, back_te);
  out.m[1] = wt_real(wt_dot3(to.first, sent_tm)) + tm * wt_dot3(to.first, back_tm);
  out.m[2] = wt_real(wt_dot3(to.second, sent_te)) + te * wt_dot3(to.second, back_te);
  out.m[3] = wt_real(wt_dot3(to.second, sent_tm)) + tm * wt_dot3(to.second, back_tm);
  return out;
}

// integral_m2: that of exp(j phase) over the facet. The result is in metres: with S its product with the matrix above,
// the radar cross section is 4 pi |S|^2.
inline wt_double2 wt_facet_amplitude(wt_double2 integral_m2, double wavelength_m) {
  return WT_DOUBLE2(-integral_m2.y, integral_m2.x) * (0.5 / wavelength_m);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
