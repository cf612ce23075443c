// SPDX-License-Identifier: Apache-2.0
// Complex numbers as pairs of doubles (x: real, y: imaginary): the same bits on host and devices.
// Vector operations serve for sums, differences and products with a real number.
#ifndef WAVETRACER_DEVICE_COMPLEX_H
#define WAVETRACER_DEVICE_COMPLEX_H
#include "wavetracer/device/elementary.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

inline wt_double2 wt_real(double x) { return WT_DOUBLE2(x, 0.0); }
// The rounded product a * b. Intel's compiler for CPUs turns the difference and the sum of two pairs of products into
// one operation (vfmaddsub), which rounds once even where FP_CONTRACT forbids it. It does not touch a product that is
// written as fma with -0.
#ifdef __OPENCL_VERSION__
inline double wt_product(double a, double b) { return fma(a, b, -0.0); }
#else
inline double wt_product(double a, double b) { return a * b; }
#endif

inline wt_double2 wt_times(wt_double2 a, wt_double2 b) {
  return WT_DOUBLE2(wt_product(a.x, b.x) - wt_product(a.y, b.y), wt_product(a.x, b.y) + wt_product(a.y, b.x));
}
inline double wt_norm(wt_double2 a) { return a.x * a.x + a.y * a.y; }  // |a|^2
// a / b. Where |b|^2 may overflow (the permittivity of a metal) or vanish, b is scaled first.
inline wt_double2 wt_over(wt_double2 a, wt_double2 b) {
  const double plain = wt_norm(b);
  double x = b.x, y = b.y, norm = plain;
  if (!(plain > 1e-200 && plain < 1e200)) {
    const double size = fmax(fabs(b.x), fabs(b.y));
    x = b.x / size;
    y = b.y / size;
    norm = (x * x + y * y) * size;
  }
  return WT_DOUBLE2(wt_product(a.x, x) + wt_product(a.y, y), wt_product(a.y, x) - wt_product(a.x, y)) * (1.0 / norm);
}
inline double wt_size(wt_double2 a) {
  const double norm = wt_norm(a);
  if (norm > 1e-200 && norm < 1e200) return sqrt(norm);
  const double larger = fmax(fabs(a.x), fabs(a.y)), smaller = fmin(fabs(a.x), fabs(a.y));
  if (larger == 0.0) return 0.0;
  const double ratio = smaller / larger;
  return larger * sqrt(1.0 + ratio * ratio);
}
// The square root whose real part is not negative.
inline wt_double2 wt_root(wt_double2 a) {
  const double size = wt_size(a);
  if (size == 0.0) return WT_DOUBLE2(0.0, a.y);
  const double part = sqrt(0.5 * (size + fabs(a.x))), other = fabs(a.y) / (2.0 * part);
  return a.x >= 0.0 ? WT_DOUBLE2(part, copysign(other, a.y)) : WT_DOUBLE2(other, copysign(part, a.y));
}

// A 2 x 2 matrix, row by row.
typedef struct {
  wt_double2 m[4];
} wt_matrix;

inline wt_matrix wt_matrix_product(wt_matrix a, wt_matrix b) {
  wt_matrix out;
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column)
      out.m[2 * row + column] = wt_times(a.m[2 * row], b.m[column]) + wt_times(a.m[2 * row + 1], b.m[2 + column]);
  return out;
}
inline wt_matrix wt_scaled(wt_matrix a, wt_double2 factor) {
  for (int i = 0; i < 4; ++i) a.m[i] = wt_times(a.m[i], factor);
  return a;
}
inline wt_matrix wt_matrix_sum(wt_matrix a, double factor, wt_matrix b) {  // a + factor b
  for (int i = 0; i < 4; ++i) a.m[i] = a.m[i] + b.m[i] * factor;
  return a;
}
inline wt_matrix wt_diagonal(wt_double2 first, wt_double2 second) {
  wt_matrix out;
  out.m[0] = first;
  out.m[1] = out.m[2] = wt_real(0.0);
  out.m[3] = second;
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
