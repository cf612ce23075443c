// SPDX-License-Identifier: Apache-2.0
// Sine, cosine, exponential, logarithm and arc tangent in double with the same bits on every device, since OpenCL lets
// each device have its own. Polynomials and breakpoints are those of FDLIBM (Sun Microsystems, 1993;
// netlib.org/fdlibm), which bounds their errors. Only + - * / sqrt, fma and ldexp are used.
// tests/radio/elementary_test.cpp has the errors.
#ifndef WAVETRACER_DEVICE_ELEMENTARY_H
#define WAVETRACER_DEVICE_ELEMENTARY_H
#include "wavetracer/device/vector.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The whole number nearest to x, |x| <= 2^51; the even one of two. Above 2^52 doubles have no digits after the point,
// so the sum rounds. Some devices compute rint in many steps.
inline double wt_nearest_whole(double x) { return (x + 6755399441055744.0) - 6755399441055744.0; }

// Returns x: cosine, y: sine, for |angle| <= 2^44 rad. Beyond 2^30 the quarter turn may not be the nearest by a
// thousandth. The angle's distance from it is computed in three parts: the first product is exact in fma, because the
// difference is a multiple of the last place of both.
inline wt_double2 wt_cos_sin(double angle) {
  const double quarters = wt_nearest_whole(angle * 0.63661977236758134);
  const double first = fma(-quarters, 1.5707963267948966, angle);
  const double correction = quarters * 6.123233995736766e-17;
  const double r = first - correction;
  const double lost = fma(quarters, 6.123233995736766e-17, -correction) + quarters * -1.4973849048591833e-33;
  const double tail = ((first - r) - correction) - lost;
  const double z = r * r;
  // This is the sine on [-pi/4, pi/4].
  const double s =
      8.33333333332248946124e-03 +
      z * (-1.98412698298579493134e-04 +
           z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
  const double v = z * r;
  const double sine = r - ((z * (0.5 * tail - v * s) - tail) - v * -1.66666666666666324348e-01);
  // This is the cosine, with the part of 1 - z / 2 that rounding loses.
  const double c = z * (4.16666666666666019037e-02 +
                        z * (-1.38888888888741095749e-03 +
                             z * (2.48015872894767294178e-05 +
                                  z * (-2.75573143513906633035e-07 +
                                       z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const double halved = 0.5 * z, most = 1.0 - halved;
  const double cosine = most + (((1.0 - most) - halved) + (z * c - r * tail));
  // The quarter is selected without a branch: no CPU predicts in which quarter an angle lies.
  const int turn = (int)(quarters - 4.0 * wt_nearest_whole(0.25 * quarters)) & 3;
  const double x = turn & 1 ? sine : cosine, y = turn & 1 ? cosine : sine;
  return WT_DOUBLE2(turn == 1 || turn == 2 ? -x : x, turn >= 2 ? -y : y);
}

// exp(r) - 1 for |r| up to about 0.35.
inline double wt_small_expm1(double r, double tail) {
  const double x = r - tail, z = x * x;
  const double c =
      x -
      z * (1.66666666666666019037e-01 +
           z * (-2.77777777770155933842e-03 +
                z * (6.61375632143793436117e-05 + z * (-1.65339022054652515390e-06 + z * 4.13813679705723846039e-08))));
  return r - (tail - x * c / (2.0 - c));
}

// exp(x), 0 below -745 and infinite above 709.78.
inline double wt_exp(double x) {
  if (!(x > -745.0)) return x == x ? 0.0 : x;
  if (x > 709.78) return WT_INFINITY;
  const double k = wt_nearest_whole(x * 1.44269504088896338700);
  const double r = fma(-k, 6.93147180369123816490e-01, x);
  return ldexp(1.0 + wt_small_expm1(r, k * 1.90821492927058770002e-10), (int)k);
}

// x: exp(x); y: exp(x) - 1 with all its digits near 0.
inline wt_double2 wt_exp_and_expm1(double x) {
  if (fabs(x) < 0.34) {
    const double less = wt_small_expm1(x, 0.0);
    return WT_DOUBLE2(1.0 + less, less);
  }
  const double size = wt_exp(x);
  return WT_DOUBLE2(size, size - 1.0);
}
inline double wt_expm1(double x) { return wt_exp_and_expm1(x).y; }

// The decimal logarithm of x >= 0; 0 gives -infinity. x is split into 2^k (1 + f) with 1 + f around 1.
inline double wt_log10(double x) {
  if (!(x > 0.0)) return x == 0.0 ? -WT_INFINITY : x - x;
  if (x == WT_INFINITY) return x;
  double k = 0.0;
  for (; x < 1e-290; x *= 0x1p60) k -= 60.0;
#ifdef __OPENCL_VERSION__
  int e;
  double m = frexp(x, &e);
#else
  int e;
  double m = std::frexp(x, &e);
#endif
  if (m < 0.70710678118654752) {
    m *= 2.0;
    e -= 1;
  }
  k += (double)e;
  const double f = m - 1.0, s = f / (2.0 + f), z = s * s, w = z * z;
  const double even = w * (3.999999999940941908e-01 + w * (2.222219843214978396e-01 + w * 1.531383769920937332e-01));
  const double odd =
      z * (6.666666666666735130e-01 +
           w * (2.857142874366239149e-01 + w * (1.818357216161805012e-01 + w * 1.479819860511658591e-01)));
  const double halved = 0.5 * f * f;
  const double small = s * (halved + (even + odd));  // log(1 + f) = f - halved + small
  return k * 3.01029995663611771306e-01 +
         ((f - (halved - small)) * 4.34294481903251816668e-01 + k * 3.69423907715893078616e-13);
}

// The arc tangent of x >= 0, up to infinity.
inline double wt_positive_atan(double x) {
  double reference = 0.0, rest = 0.0, t = x;
  if (x >= 2.4375) {
    reference = 1.57079632679489655800;
    rest = 6.12323399573676603587e-17;
    t = -1.0 / x;
  } else if (x >= 1.1875) {
    reference = 9.82793723247329054082e-01;
    rest = 1.39033110312309984516e-17;
    t = (x - 1.5) / (1.0 + 1.5 * x);
  } else if (x >= 0.6875) {
    reference = 7.85398163397448278999e-01;
    rest = 3.06161699786838301793e-17;
    t = (x - 1.0) / (x + 1.0);
  } else if (x >= 0.4375) {
    reference = 4.63647609000806093515e-01;
    rest = 2.26987774529616870924e-17;
    t = (2.0 * x - 1.0) / (2.0 + x);
  }
  const double z = t * t, w = z * z;
  const double odd = z * (3.33333333333329318027e-01 +
                          w * (1.42857142725034663711e-01 +
                               w * (9.09088713343650656196e-02 +
                                    w * (6.66107313738753120669e-02 +
                                         w * (4.97687799461593236017e-02 + w * 1.62858201153657823623e-02)))));
  const double even =
      w *
      (-1.99999999998764832476e-01 +
       w * (-1.11111104054623557880e-01 +
            w * (-7.69187620504482999495e-02 + w * (-5.83357013379057348645e-02 + w * -3.65315727442169155270e-02))));
  return reference - ((t * (odd + even) - rest) - t);
}

// The angle of (x, y), -pi to pi. As in the library's atan2 the signs of zeros count, those of x and of y.
inline double wt_atan2(double y, double x) {
  const double ax = fabs(x), ay = fabs(y);
  double angle;
  if (ax == 0.0)
    angle = ay == 0.0 ? 0.0 : 1.57079632679489655800;
  else
    angle = wt_positive_atan(ay / ax);
  if (copysign(1.0, x) < 0.0) angle = WT_PI - (angle - 1.2246467991473532e-16);
  return copysign(angle, y);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
