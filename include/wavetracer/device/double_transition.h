// SPDX-License-Identifier: Apache-2.0
// The transition function of two edges, and the places where waves pass over them: as transition.h for one edge.
//   g2(x, y, r) = (2j)^2 times the integral over u, v > 0 of exp(-j (u^2 + v^2 - 2 r u v + 2 x u + 2 y v)),
// so g2(x, y, 0) = g(x) g(y), and with r = 1 the two edges are one. It is the double integral of L. Vogler (Radio
// Science 17(6), 1982), without the phase of the diffracted ray. It resembles Owen's T function: u and v are turned by
// -45 degrees, where the integrand decays, and the integral along each ray from u = v = 0 is h(s) = 1 - s g(s). The
// integral of h over the directions of these rays remains, from that of s = x to that of s = y.
#ifndef WAVETRACER_DEVICE_DOUBLE_TRANSITION_H
#define WAVETRACER_DEVICE_DOUBLE_TRANSITION_H
#include "wavetracer/device/transition.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Smaller arguments are replaced by this one, so that s = x and s = y have a direction.
#define WT_LEAST_ARGUMENT 1e-9

// If the product of the arguments is larger than this, two terms of the series in r give g2 with a relative error of
// 2e-4.
#define WT_FAR_EDGES 40.0

// From this argument on, the mean of u is that of a single edge.
#define WT_FAR_EDGE 20.0

// h(s) belongs to the slope of a wave across the edge as g(s) belongs to the wave.
inline wt_double2 wt_slope_transition(double s) { return wt_real(1.0) - wt_transition_over_root(s) * s; }

// The integral of h over directions, from that of s = x by an angle whose tangent is reach: s = (x + e t) / sqrt(1 +
// t^2) at the tangent t. e is positive. Gauss-Legendre integration uses a variable in which h is nearly a polynomial
// for small and for large e; g2 has a relative error of 3e-5.
inline wt_double2 wt_sum_of_slopes(double x, double e, double reach) {
  const double nodes[4] = {0.019855071751231911925, 0.10166676129318663602, 0.23723379504183550459,
                           0.40828267875217510996};
  const double weights[4] = {0.050614268145188531789, 0.11119051722668721327, 0.15685332293894344025,
                             0.18134189168918082857};
  const double scale = (x + 1.8) / (x + 1.8 + e), end = reach / (scale + reach);
  wt_double2 sum = wt_real(0.0);
  for (int i = 0; i < 8; ++i) {
    const double at = end * (i < 4 ? nodes[i] : 1.0 - nodes[7 - i]), rest = 1.0 - at;
    const double t = scale * at / rest, square = 1.0 + t * t;
    const wt_double2 h = wt_slope_transition((x + e * t) / sqrt(square));
    sum = sum + h * (weights[i < 4 ? i : 7 - i] * end * scale / (rest * rest * square));
  }
  return sum;
}

// x, y: 0 or more; r: between -1 and 1, both excluded.
inline wt_double2 wt_double_transition(double x, double y, double r) {
  const double a = fmax(x, WT_LEAST_ARGUMENT), b = fmax(y, WT_LEAST_ARGUMENT);
  if (a * b > WT_FAR_EDGES) {
    const wt_double2 slopes = wt_times(wt_slope_transition(a), wt_slope_transition(b)) * (2.0 * r);
    return wt_times(wt_transition_over_root(a), wt_transition_over_root(b)) + WT_DOUBLE2(-slopes.y, slopes.x);
  }
  const double c = sqrt((1.0 - r) * (1.0 + r)), e = (b + r * a) / c, f = (a + r * b) / c;
  wt_double2 sum;
  if (e <= 0.0)
    sum = wt_sum_of_slopes(b, f, c / -r);
  else if (f <= 0.0)
    sum = wt_sum_of_slopes(a, e, c / -r);
  else
    sum = wt_sum_of_slopes(a, e, e / a) + wt_sum_of_slopes(b, f, f / b);
  return WT_DOUBLE2(-sum.y, sum.x) * (2.0 / c);
}

// The means of u and v, weighted by the integrand of g2, whose integral is `whole`: complex numbers.
typedef struct {
  wt_double2 u, v;
} wt_double_means;

inline wt_double_means wt_means_of(double x, double y, double r, wt_double2 whole) {
  const wt_double2 gx = wt_transition_over_root(x), gy = wt_transition_over_root(y);
  const int far_x = x > WT_FAR_EDGE, far_y = y > WT_FAR_EDGE;
  wt_double2 u, v;
  if (far_x) u = wt_over(wt_times(whole, wt_slope_transition(x)), gx);
  if (far_y) v = wt_over(wt_times(whole, wt_slope_transition(y)), gy);
  // The integrals of the derivatives by u and by v are known: u - r v = g(y) - x g2 and v - r u = g(x) - y g2.
  const wt_double2 p = gy - whole * x, q = gx - whole * y;
  if (!far_x) u = far_y ? p + v * r : (p + q * r) / ((1.0 - r) * (1.0 + r));
  if (!far_y) v = q + u * r;
  wt_double_means out;
  out.u = wt_over(u, whole);
  out.v = wt_over(v, whole);
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
