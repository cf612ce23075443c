// SPDX-License-Identifier: Apache-2.0
// The transition function of the uniform theory of diffraction, with a relative error below 1e-14.
// g(s) = sqrt(pi) exp(j pi / 4) erfcx(u) at u = exp(j pi / 4) s, where erfcx(u) = exp(u^2) erfc(u) is the scaled
// complement (M. Abramowitz and I. Stegun, 7.1). One polynomial serves all arguments, without branches: neighbours on a
// GPU are at different distances from their shadow boundaries, and would wait for each other.
#ifndef WAVETRACER_DEVICE_TRANSITION_H
#define WAVETRACER_DEVICE_TRANSITION_H
#include "wavetracer/device/complex.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

#define WT_INV_SQRT_PI 0.56418958354775628695
#define WT_EIGHTH_TURN WT_DOUBLE2(0.70710678118654752440, 0.70710678118654752440)

// (3 + s) g(s) is smooth in t = (3 - s) / (3 + s), from t = 1 where s is 0 down to -1 where s is infinite. This is its
// Chebyshev interpolation at 39 nodes, computed with 40 digits and written in powers of t. Row i has the real and the
// imaginary coefficient of t^(2 i), then those of t^(2 i + 1).
#define WT_TRANSITION_ROWS 20
WT_NUMBERS double wt_transition_rows[WT_TRANSITION_ROWS][4] = {
    {1.9830733377243746, 0.10669900108777697, 1.8580907014355121, 0.5026608408346738},
    {1.4280583748498394, 1.1376667704406853, 0.5300926656766637, 1.6324977195978718},
    {-0.6569152223134492, 1.4737831225159412, -1.457804412013925, 0.440525628100681},
    {-1.1326594544229034, -0.8965589833221561, 0.20753359332475382, -1.361206954709343},
    {1.2633685790377727, -0.3765459248199958, 0.7798794505175265, 0.9985834008729174},
    {-0.6839805658891505, 1.0125045878978367, -1.1165527532154866, -0.38713714733794563},
    {0.13867673518559584, -1.1374677369171446, 1.1121717255694414, -0.05320149093000073},
    {0.19118924154809802, 1.067205404831841, -1.0182261468867857, 0.283205003507769},
    {-0.3357903663773856, -0.9766095995857886, 0.941536994050512, -0.359293353669325},
    {0.3530484470232748, 0.9230753444660607, -0.8999675753881587, 0.33448733769753675},
    {-0.2855489074560882, -0.9020628897956902, 0.8663666628221497, -0.24834402069526373},
    {0.16815875593109292, 0.8785109872401857, -0.7967265261071209, 0.13821712698601532},
    {-0.04109334242352814, -0.8084347952087262, 0.6601703936557377, -0.04200549049741505},
    {-0.05290143859861594, 0.6657481342627571, -0.46675040407211105, -0.01402198382747056},
    {0.08859768507760182, -0.466434165975329, 0.2674712427827904, 0.02823927971204654},
    {-0.07410694755525583, 0.26473597899564394, -0.11753030266164342, -0.019424895057357772},
    {0.040593906430291656, -0.11528973143906772, 0.03680688445848235, 0.007815540261653535},
    {-0.014682259402051133, 0.035820136407267014, -0.007268299992269085, -0.001814707415840318},
    {0.0032062543893291396, -0.007025302257269184, 0.0006773120171826653, 0.00018937254204749854},
    {-0.0003216067855933954, 0.0006508671484235586, 0.0, 0.0}};

// g(s) = 2j exp(j s^2) times the integral of exp(-j t^2) from s to infinity, s >= 0. It is finite at 0, and 1 / s for
// large s.
inline wt_double2 wt_transition_over_root(double s) {
  const double t = (3.0 - s) / (3.0 + s), w = t * t;
  double even_real = 0.0, even_imag = 0.0, odd_real = 0.0, odd_imag = 0.0;
  for (int i = WT_TRANSITION_ROWS - 1; i >= 0; --i) {
    even_real = fma(even_real, w, wt_transition_rows[i][0]);
    even_imag = fma(even_imag, w, wt_transition_rows[i][1]);
    odd_real = fma(odd_real, w, wt_transition_rows[i][2]);
    odd_imag = fma(odd_imag, w, wt_transition_rows[i][3]);
  }
  return WT_DOUBLE2(fma(t, odd_real, even_real), fma(t, odd_imag, even_imag)) / (3.0 + s);
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
