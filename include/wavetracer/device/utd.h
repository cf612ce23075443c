// SPDX-License-Identifier: Apache-2.0
// The uniform theory of diffraction at a straight wedge with faces of any material, as host/radio/utd.hpp describes it.
// It has four terms: each is the jump of a geometrical wave at its shadow boundary times a function that is half of
// that jump on either side of the boundary. Local axes are x along face 0, y along its normal, and z along the edge.
#ifndef WAVETRACER_DEVICE_UTD_H
#define WAVETRACER_DEVICE_UTD_H
#include "wavetracer/device/edge_bend.h"
#include "wavetracer/device/edge_ends.h"
#include "wavetracer/device/transition.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The field at the edge, in components along from, times the matrix is the field that leaves it, in components along
// to.
typedef struct {
  wt_basis from, to;
  wt_matrix matrix;
} wt_wave_map;

// Does a wave run along a face, so that it and its reflection are one wave?
inline int wt_grazes(double azimuth, double exterior) {
  return azimuth < WT_GRAZING_RAD || exterior - azimuth < WT_GRAZING_RAD;
}

// The factor of the sum of an edge's terms: sqrt(L / pi) / 2n exp(3 j pi / 4).
inline wt_double2 wt_edge_amplitude(double distance_m, double n) {
  const double size = sqrt(distance_m / WT_PI) / (2.0 * n);
  return WT_DOUBLE2(-size, size) * 0.70710678118654752440;
}

// The matrix is in sqrt(m), see Diffraction in host/radio/utd.hpp. turn: that of these directions. distance_m: s s'
// sin^2 beta0 / (s + s'). ends: those of the edge.
inline wt_wave_map wt_diffract(wt_wedge_frame wedge, const wt_wedge_face* faces, wt_double3 k_in, wt_double3 k_out,
                               const wt_turn* turn, const double* legs_m, double distance_m, double wavelength_m,
                               int transmits, const wt_known_waves* known, const wt_edge_ends* ends) {
  wt_wave_map out;
  out.matrix = wt_diagonal(wt_real(0.0), wt_real(0.0));
  if (!wt_turns(&wedge, k_in, k_out)) {
    out.from.first = out.to.first = wedge.face;
    out.from.second = out.to.second = wedge.normal;
    return out;
  }
  const wt_bend bend = wt_bend_at(&wedge, faces, k_in, k_out, legs_m, turn, wavelength_m, transmits);
  const double root_2kl = sqrt(4.0 * WT_PI * distance_m / wavelength_m);
  for (int term = 0; term < WT_BOUNDARIES; ++term) {
    const wt_boundary boundary = turn->boundaries[term];
    const int images = boundary.image < 0 ? -boundary.image : boundary.image;
    if (wedge.exterior < WT_PI && images > 1 && images > known->most_images) continue;  // no such wave ends here
    const wt_term_factors factors = wt_factors_of(wt_decided(boundary, known, term), bend.n);
    const double s = root_2kl * factors.sine;
    const wt_double2 g = wt_transition_over_root(s);
    const wt_double2 factor = (ends->counts ? wt_transition_between(s, g, ends) : g) * factors.ratio;
    wt_double2 spread = wt_real(0.0);
    if (term >= 2 && wedge.exterior >= WT_PI)
      spread = wt_spread_of(s, g, copysign(root_2kl * wavelength_m / (2.0 * WT_PI), -factors.ratio));
    const wt_matrix jump = wt_jump(&bend, term, root_2kl, 0, spread);
    for (int i = 0; i < 4; ++i) out.matrix.m[i] = out.matrix.m[i] + wt_times(factor, jump.m[i]);
  }
  const int grazes = wt_grazes(turn->in, wedge.exterior) || wt_grazes(turn->away, wedge.exterior);
  out.matrix = wt_scaled(out.matrix, wt_edge_amplitude(distance_m, bend.n) * (grazes ? 0.5 : 1.0));
  // These are the bases of the bend, computed here, so that no registers keep them meanwhile.
  out.from = wt_coming(wedge.along, k_in);
  out.to = wt_leaving(wedge.along, k_out);
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
