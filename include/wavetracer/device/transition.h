// SPDX-License-Identifier: Apache-2.0
// The transition function of the uniform theory of diffraction, with a relative error below 1e-11.
// g(s) = sqrt(pi) exp(j pi / 4) erfcx(u) at u = exp(j pi / 4) s, where erfcx(u) = exp(u^2) erfc(u) is the scaled
// complement.
// Three expansions of it meet at s = 3 and s = 8, where both neighbours have all digits. Most edges are far from their
// shadow boundaries, beyond 8, and there a few multiplications suffice. Numbers of formulas are those of M. Abramowitz
// and I. Stegun.
#ifndef WAVETRACER_DEVICE_TRANSITION_H
#define WAVETRACER_DEVICE_TRANSITION_H
#include "wavetracer/device/complex.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

#define WT_INV_SQRT_PI 0.56418958354775628695
#define WT_EIGHTH_TURN WT_DOUBLE2(0.70710678118654752440, 0.70710678118654752440)

// The quotient of a real number and a complex one.
inline wt_double2 wt_real_over(double a, wt_double2 b) { return WT_DOUBLE2(b.x, -b.y) * (a / wt_norm(b)); }

// Formula 7.1.6: exp(u^2) erf(u) = 2 / sqrt(pi) times the sum of 2^k u^(2k+1) / (2k+1)!!. Since u^2 = j s^2, each term
// is real or imaginary, apart from the factor u.
inline wt_double2 wt_erfcx_by_series(wt_double2 u, double s) {
  const double step = 2.0 * s * s;
  double real = 1.0, imag = 0.0, term = 1.0;
  for (double odd = 3.0; term > 1e-18; odd += 8.0) {
    imag += term *= step / odd;
    real -= term *= step / (odd + 2.0);
    imag -= term *= step / (odd + 4.0);
    real += term *= step / (odd + 6.0);
  }
  return wt_cos_sin(s * s) - wt_times(u, WT_DOUBLE2(real, imag)) * (2.0 * WT_INV_SQRT_PI);
}

// Formula 7.1.14: sqrt(pi) erfcx(u) = 1 / (u + (1/2) / (u + 1 / (u + (3/2) / (u + ...)))). Numerator and denominator
// are computed from the head, x(k+1) = u x(k) + k / 2 x(k-1), so there is one division.
inline wt_double2 wt_erfcx_by_fraction(wt_double2 u) {
  wt_double2 above = wt_real(1.0), above_before = wt_real(0.0), below = u, below_before = wt_real(1.0);
  for (int k = 1; k <= 60; ++k) {
    const wt_double2 next_above = wt_times(u, above) + above_before * (0.5 * k);
    const wt_double2 next_below = wt_times(u, below) + below_before * (0.5 * k);
    above_before = above;
    below_before = below;
    above = next_above;
    below = next_below;
  }
  return wt_over(above, below) * WT_INV_SQRT_PI;
}

// Formula 7.1.23: sqrt(pi) u erfcx(u) ~ 1 - 1 / (2 u^2) + 1 * 3 / (2 u^2)^2 - ...; u^2 = j s^2, so the terms shrink
// until the s^2-th, which is of the size exp(-s^2).
inline wt_double2 wt_erfcx_far(wt_double2 u, double s) {
  const double step = 1.0 / (2.0 * s * s);
  double real = 1.0, imag = 0.0, term = 1.0;  // each term is j / (2 s^2) times its odd number times the one before
  for (int k = 1; term > 1e-17; k += 8) {
    imag += term *= k * step;
    real -= term *= (k + 2) * step;
    imag -= term *= (k + 4) * step;
    real += term *= (k + 6) * step;
  }
  return wt_times(WT_DOUBLE2(real, imag), wt_real_over(WT_INV_SQRT_PI, u));
}

// g(s) = 2j exp(j s^2) times the integral of exp(-j t^2) from s to infinity, s >= 0. It is finite at 0, and 1 / s for
// large s.
WT_CALLED wt_double2 wt_transition_over_root(double s) {
  const wt_double2 front = WT_EIGHTH_TURN * (1.0 / WT_INV_SQRT_PI), u = WT_EIGHTH_TURN * s;
  if (s == 0.0) return front;
  if (s < 3.0) return wt_times(front, wt_erfcx_by_series(u, s));
  return wt_times(front, s < 8.0 ? wt_erfcx_by_fraction(u) : wt_erfcx_far(u, s));
}

// g of any argument: the integral over the whole line less that beyond -s.
inline wt_double2 wt_transition_of_any(double s) {
  const wt_double2 g = wt_transition_over_root(fabs(s));
  return s < 0.0 ? wt_times(wt_cos_sin(s * s), WT_EIGHTH_TURN) * (2.0 / WT_INV_SQRT_PI) - g : g;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
