// SPDX-License-Identifier: Apache-2.0
// Reflection and transmission of a plane wave at a single-layer slab in free space (ITU-R P.2040-3, section 2.2.2),
// written so that no quotient loses its digits. host/radio/slab.hpp explains the signs.
// Time convention exp(+j 2 pi f t): a wave that decays goes as exp(-j q) with Im q <= 0.
#ifndef WAVETRACER_DEVICE_SLAB_H
#define WAVETRACER_DEVICE_SLAB_H
#include "wavetracer/device/complex.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

typedef struct {
  wt_double2 reflection_te, reflection_tm, transmission_te, transmission_tm;
} wt_slab;

// A slab that is thicker than this many radians is a half space: thickness and frequency are not known well enough to
// give a phase to what comes back from its far side, and it comes back much too late to matter. wt_cos_sin goes as far.
#define WT_ENDLESS_RAD 0x1p44

// The wave inside: s = sqrt(eta - sin^2 theta) is its normal wave number over that of free space. All three powers of
// exp(-j q) are made of the sine and the exponential of one pass.
typedef struct {
  wt_double2 s;
  int half_space;         // nothing comes back from the far side
  wt_double2 one_pass;    // exp(-j q), q = 2 pi (d / lambda) s
  wt_double2 round_trip;  // E = exp(-2 j q)
  wt_double2 missing;     // (1 - E) / s, which stays finite where s vanishes
} wt_inside;

inline wt_inside wt_inside_of(wt_double2 permittivity, double cos_theta, double thickness_m, double wavelength_m) {
  wt_inside in;
  in.s = wt_root(permittivity - wt_real(1.0 - cos_theta * cos_theta));
  if (in.s.y > 0.0) in.s = -in.s;  // the branch that decays, also for a real eta below sin^2 theta
  const double kd = 2.0 * WT_PI * thickness_m / wavelength_m, damping = kd * in.s.y;
  in.half_space = !(kd * fmax(fabs(in.s.x), fabs(in.s.y)) < WT_ENDLESS_RAD);
  in.one_pass = in.round_trip = in.missing = wt_real(0.0);
  if (in.half_space) return in;
  const wt_double2 turn = wt_cos_sin(-kd * in.s.x);
  const wt_double2 damped = wt_exp_and_expm1(damping);
  const double size = damped.x, lost = damped.y;
  in.one_pass = turn * size;
  in.round_trip = wt_times(in.one_pass, in.one_pass);
  if (in.s.x == 0.0 && in.s.y == 0.0) {
    in.missing = WT_DOUBLE2(0.0, 2.0 * kd);
    return in;
  }
  // This is 1 - E without the cancellation at a small q: exp(2 x) - 1 = (exp(x) - 1) (exp(x) + 1), cos(2 y) = 1 - 2
  // sin(y)^2.
  const double twice_sine2 = 2.0 * turn.y * turn.y;
  const wt_double2 rest = WT_DOUBLE2(twice_sine2 - lost * (lost + 2.0) * (1.0 - twice_sine2), -in.round_trip.y);
  in.missing = wt_over(rest, in.s);
  return in;
}

// With r = (u - s) / (u + s), where u = cos theta (TE) or eta cos theta (TM), P.2040's
//   R = r (1 - E) / (1 - r^2 E),  T = (1 - r^2) exp(-j q) / (1 - r^2 E)
// multiplied out by (u + s)^2 / s. difference is u^2 - s^2, in a form without cancellation. u is not zero.
inline void wt_slab_of(const wt_inside* in, wt_double2 u, wt_double2 difference, wt_double2* reflection,
                       wt_double2* transmission) {
  if (in->half_space) {
    *reflection = wt_over(difference, wt_times(u + in->s, u + in->s));
    *transmission = wt_real(0.0);
    return;
  }
  const wt_double2 squares = wt_times(u, u) + wt_times(in->s, in->s);
  const wt_double2 denominator = wt_times(squares, in->missing) + wt_times(u, wt_real(1.0) + in->round_trip) * 2.0;
  const wt_double2 share = wt_over(wt_real(1.0), denominator);
  *reflection = wt_times(wt_times(difference, in->missing), share);
  *transmission = wt_times(wt_times(u, in->one_pass) * 4.0, share);
}

// permittivity: relative; cos_theta: 0 (grazing) to 1; thickness_m: 0 or more; infinity is the half space, and so is a
// thickness above WT_ENDLESS_RAD.
WT_CALLED wt_slab wt_slab_coefficients(wt_double2 permittivity, double cos_theta, double thickness_m,
                                       double wavelength_m) {
  wt_slab out;
  const double c = cos_theta;
  const wt_double2 contrast = permittivity - wt_real(1.0);
  if (c == 0.0) {  // the limit of grazing incidence for every slab; an empty slab lets the wave pass
    const int empty = (contrast.x == 0.0 && contrast.y == 0.0) || thickness_m == 0.0;
    out.reflection_te = out.reflection_tm = wt_real(empty ? 0.0 : -1.0);
    out.transmission_te = out.transmission_tm = wt_real(empty ? 1.0 : 0.0);
    return out;
  }
  const wt_inside in = wt_inside_of(permittivity, c, thickness_m, wavelength_m);
  wt_slab_of(&in, wt_real(c), -contrast, &out.reflection_te, &out.transmission_te);
  const wt_double2 difference = wt_times(contrast, (permittivity + wt_real(1.0)) * (c * c) - wt_real(1.0));
  wt_slab_of(&in, permittivity * c, difference, &out.reflection_tm, &out.transmission_tm);
  return out;
}

// A permittivity so large, of 1e7 S/m up to 180 GHz, is that of a good conductor.
#define WT_CONDUCTS 1e6

// The cosine of incidence of the waves that fill the zone about a path of this length where it grazes a plane. A
// plane whose surface impedance is that much smaller reflects in all as it reflects at this angle: with F the
// attenuation of Norton (Proc. IRE 25, 1937), R + (1 - R) F is 1 - sqrt(2 pi k L) / sqrt(permittivity) at grazing.
inline double wt_zone_cosine(double length_m, double wavelength_m) { return sqrt(wavelength_m / length_m) / WT_PI; }

// The cosine at which a material reflects a wave of a path. A good conductor reflects plane waves below its Brewster
// angle, 1 / sqrt(permittivity), with another sign than above it, but the zone about a path is much wider than that.
inline double wt_cosine_of_zone(wt_double2 permittivity, double cos_theta, double zone) {
  if (cos_theta >= zone) return cos_theta;
  return wt_size(permittivity) > WT_CONDUCTS ? zone : cos_theta;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
