// SPDX-License-Identifier: Apache-2.0
// Diffuse scattering by a tile of a rough surface: the effective roughness model as host/radio/scattering.hpp describes
// it, made reciprocal. Random phases are hashes, the same on every machine.
#ifndef WAVETRACER_DEVICE_SCATTERING_H
#define WAVETRACER_DEVICE_SCATTERING_H
#include "wavetracer/device/field_records.h"
#include "wavetracer/device/layers.h"
#include "wavetracer/device/utd.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The finaliser of SplitMix64 (G. Steele, D. Lea, C. Flood, OOPSLA 2014): a bijection that mixes every bit.
inline wt_ulong wt_mixed(wt_ulong x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ul;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBul;
  return x ^ (x >> 31);
}

// pair: 0 is TE to TE, 1 is TM to TM, 2 is TE to TM and TM to TE. mirrors: wt_mirrors_around in path_vertex.h, 0 for a
// tile or a cell without mirrors around it.
inline wt_double2 wt_random_phase(wt_ulong seed, wt_uint tile, wt_ulong mirrors, wt_ulong pair) {
  const wt_ulong bits = wt_mixed(wt_mixed(seed + 0x9E3779B97F4A7C15ul) + mirrors + 3ul * tile + pair);
  return wt_cos_sin(2.0 * WT_PI * (double)(bits >> 11) * 0x1p-53);
}

// The integral of ((1 + cos psi) / 2)^alpha over the hemisphere, where psi is the angle from the mirrored direction.
inline double wt_lobe_integral(wt_uint alpha, double cos_theta) {
  const double quarter_sine2 = (1.0 - cos_theta * cos_theta) / 4.0;
  double sum = 0.0, binomial = ldexp(1.0, -(int)alpha);  // binomial (alpha, j) over 2^alpha
  double series = 0.0, term = 1.0;  // sum over w of (2w, w) (sin^2 theta / 4)^w, up to w = (j - 1) / 2
  for (wt_uint j = 0; j <= alpha; ++j) {
    if (j % 2 == 1) {
      const double w = (double)((j - 1) / 2);
      series += term;
      term *= quarter_sine2 * 2.0 * (2.0 * w + 1.0) / (w + 1.0);
    }
    sum += binomial * 2.0 * WT_PI / (j + 1.0) * (j % 2 == 1 ? cos_theta * series : 1.0);
    binomial *= (double)(alpha - j) / (j + 1.0);
  }
  return sum;
}

inline double wt_power(double x, wt_uint exponent) {
  double out = 1.0;
  for (; exponent > 0; exponent >>= 1, x *= x)
    if (exponent & 1u) out *= x;
  return out;
}

// cos(theta_i) f in 1/sr: scattering_pattern of host/radio/scattering.hpp.
inline double wt_scattering_pattern(wt_uint alpha, double cos_in, double cos_out, double cos_psi) {
  if (alpha == 0) return cos_in * cos_out / WT_PI;
  const double lobe = wt_power(fmin(fmax((1.0 + cos_psi) / 2.0, 0.0), 1.0), alpha);
  // cos(theta) / F grows with cos(theta), so the more grazing of the two directions has the smaller one.
  const double grazing = fmin(cos_in, cos_out);
  return lobe * grazing / wt_lobe_integral(alpha, grazing);
}

// Square roots of |R|: x for TE, y for TM.
inline wt_double2 wt_roots_of_reflection(const wt_material* material, wt_layers layers, double cos_theta,
                                         double wavelength_m) {
  const wt_slab slab = wt_wall_coefficients(layers, WT_DOUBLE2(material->permittivity[0], material->permittivity[1]),
                                            cos_theta, material->thickness_m, wavelength_m);
  return WT_DOUBLE2(sqrt(wt_size(slab.reflection_te)), sqrt(wt_size(slab.reflection_tm)));
}

// The matrix is in metres, see ScatteredWave in host/radio/scattering.hpp. layers: those of the material, as both waves
// meet them, which are on one side. mirrors: see wt_random_phase.
inline wt_wave_map wt_scatter(const wt_material* material, wt_layers layers, double wavelength_m, wt_double3 k_in,
                              wt_double3 k_out, wt_double3 normal, double area_m2, wt_ulong seed, wt_uint tile,
                              wt_ulong mirrors) {
  const double cos_in = fmin(fabs(wt_dot3(k_in, normal)), 1.0), cos_out = fmin(fabs(wt_dot3(k_out, normal)), 1.0);
  const wt_double2 in = wt_roots_of_reflection(material, layers, cos_in, wavelength_m);
  const wt_double2 out = wt_roots_of_reflection(material, layers, cos_out, wavelength_m);
  const double cos_psi = wt_dot3(wt_mirrored(k_in, normal), k_out);
  const double amplitude_m =
      material->scattering * sqrt(area_m2 * wt_scattering_pattern(material->lobe, cos_in, cos_out, cos_psi));
  const double same = amplitude_m * sqrt(1.0 - material->cross_polar);
  const wt_double2 other = wt_random_phase(seed, tile, mirrors, 2) * (amplitude_m * sqrt(material->cross_polar));
  wt_wave_map wave;
  wave.from = wt_polarizations(k_in, normal);
  wave.to = wt_polarizations(k_out, normal);
  // On the way back both TE vectors are reversed and the TM vectors are not, so the transposed dyad has a minus here.
  wave.matrix.m[0] = wt_random_phase(seed, tile, mirrors, 0) * (same * out.x * in.x);
  wave.matrix.m[1] = other * (out.x * in.y);
  wave.matrix.m[2] = -other * (out.y * in.x);
  wave.matrix.m[3] = wt_random_phase(seed, tile, mirrors, 1) * (same * out.y * in.y);
  return wave;
}

// The wave that a cell of vegetation scatters, in metres as in wt_scatter: the share S^2 of the power that it takes,
// evenly over all directions (docs/outdoors.md). extinction: the share of the power that a metre takes there.
// Amplitudes are between the vertical and horizontal waves of both directions; on the way back both horizontal vectors
// are reversed and the vertical ones are not, hence the minus.
inline wt_wave_map wt_scatter_in_leaves(const WT_GLOBAL wt_foliage* foliage, double extinction, wt_double3 k_in,
                                        wt_double3 k_out, double volume_m3, wt_ulong seed, wt_uint tile) {
  const double amplitude_m = foliage->scattering * sqrt(extinction * volume_m3 / (4.0 * WT_PI));
  const double same = amplitude_m * sqrt(1.0 - foliage->cross_polar);
  const wt_double2 other = wt_random_phase(seed, tile, 0, 2) * (amplitude_m * sqrt(foliage->cross_polar));
  wt_wave_map wave;
  wave.from = wt_spherical_basis(k_in);
  wave.to = wt_spherical_basis(k_out);
  wave.matrix.m[0] = wt_random_phase(seed, tile, 0, 0) * same;
  wave.matrix.m[1] = other;
  wave.matrix.m[2] = -other;
  wave.matrix.m[3] = wt_random_phase(seed, tile, 0, 1) * same;
  return wave;
}

// The distance from a cell with which spreading is computed. The cell is a cube with that side, treated as a ball: near
// its middle 1 / r^2 is limited to its mean over the ball, 3 / radius^2.
inline double wt_distance_from_cell(double distance_m, double side_m) { return fmax(distance_m, 0.35816 * side_m); }

// The share of the amplitude that the mirrored wave keeps.
inline double wt_specular_share(const wt_material* material) {
  return sqrt(1.0 - material->scattering * material->scattering);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
