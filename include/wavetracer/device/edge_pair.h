// SPDX-License-Identifier: Apache-2.0
// Two edges with a straight leg between them: each term of the one with each term of the other, times the transition
// function of two edges. So slopes, grazing rays and boundaries that overlap need no special cases. Screens are exact
// in the paraxial sense (Vogler's double integral), and total fields are continuous: the jump at a boundary of one edge
// is the wave that the other edge alone diffracts. Heights over a plane that both edges bound mirror each other: the
// wave that the plane reflects between the edges has the opposite sign of r, and the reflection coefficient of the
// plane at the mean angle of the waves that graze it. A soft plane leaves the difference g2(r) - g2(-r), the slope
// wave, a hard one the sum. A good conductor is a hard plane for vertical waves, since these are much farther from
// grazing than its Brewster angle. A thin wall tends to a screen: r tends to 1.
#ifndef WAVETRACER_DEVICE_EDGE_PAIR_H
#define WAVETRACER_DEVICE_EDGE_PAIR_H
#include "wavetracer/device/grazed_plane.h"
#include "wavetracer/device/utd.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The quadratic form of a ray's length over two edges, after the points along the edges are eliminated.
typedef struct {
  double between_m;
  double spreads_m[2];    // L of each edge
  double distances_m[2];  // for wt_edge_amplitude: L sin^2 beta0
  double coupling;        // r of two terms but for the signs of their sides
} wt_pair_form;

// before_m, between_m, after_m: the legs; along: unit vectors of the edges; k: the direction from one to the other;
// sine2: sin^2 beta0. The length is a quadratic form of displacements across the edges, and the same of those along
// them. Edges at an angle couple the two; eliminating those along the edges scales the form of those across.
inline wt_pair_form wt_pair_form_of(const wt_double3* along, wt_double3 k, double before_m, double between_m,
                                    double after_m, const double* sine2) {
  const double a = 1.0 / before_m + 1.0 / between_m, b = 1.0 / between_m + 1.0 / after_m;
  const double cosine = wt_dot3(wt_normalized(wt_cross3(along[0], k)), wt_normalized(wt_cross3(along[1], k)));
  const double whole = a * b * between_m * between_m, scale = (whole - 1.0) / (whole - cosine * cosine);
  wt_pair_form out;
  out.between_m = between_m;
  out.spreads_m[0] = 1.0 / (a * scale);
  out.spreads_m[1] = 1.0 / (b * scale);
  out.distances_m[0] = out.spreads_m[0] * sine2[0];
  out.distances_m[1] = out.spreads_m[1] * sine2[1];
  out.coupling = -cosine / sqrt(whole);
  return out;
}

// The terms of one edge of a pair.
typedef struct {
  double argument[WT_BOUNDARIES];  // argument of g
  double ratio[WT_BOUNDARIES];     // see wt_term_factors
  int side[WT_BOUNDARIES];         // 1: the wave of the boundary is lit more where the leg between the edges turns to a
                            // larger azimuth; -1: it is lit less; where it is lit already, its shadow counts instead
  wt_matrix jump[WT_BOUNDARIES];
  double bent;  // wt_bent: 0 where both faces are one plane, and terms must cancel
} wt_pair_terms;

inline wt_pair_terms wt_pair_terms_of(const wt_bend* bend, const wt_known_waves* known, double distance_m, int second,
                                      int along) {
  const double root_2kl = sqrt(4.0 * WT_PI * distance_m / bend->corner.wavelength_m);
  wt_pair_terms out;
  out.bent = bend->bent;
  for (int term = 0; term < WT_BOUNDARIES; ++term) {
    const wt_boundary boundary = bend->turn.boundaries[term];
    const wt_term_factors factors = wt_factors_of(wt_decided(boundary, known, term), bend->n);
    const int grows = second || term / 2 == 1 ? boundary.turn : -boundary.turn;
    out.argument[term] = root_2kl * factors.sine;
    out.ratio[term] = factors.ratio;
    out.side[term] = factors.ratio < 0.0 ? -grows : grows;
    out.jump[term] = wt_jump(bend, term, root_2kl, along, wt_real(0.0));
  }
  return out;
}

// The reflection of the plane between term i of the first edge and term j of the second, TE and TM, as a multiple of
// the image of one side; the direct wave counts plane->sides times. image: g2 of the reflected wave, with -r.
inline void wt_reflection_over_plane(const wt_pair_terms* first, const wt_pair_terms* second, int i, int j,
                                     const wt_pair_form* form, const wt_shared_plane* plane, double wavelength_m,
                                     double r, wt_double2 image, wt_double2* te, wt_double2* tm) {
  const double x = first->argument[i], y = second->argument[j];
  const wt_double_means mean = wt_means_of(x, y, -r, image);
  *te = *tm = wt_real(0.0);
  for (int side = 0; side < plane->sides; ++side) {
    // To the lower side of a sheet the same ends are on the other side of the boundaries.
    const double sign = side == 0 ? 1.0 : -1.0;
    wt_grazing_term term;
    term.x = x;
    term.y = y;
    term.r = -r;
    // A wave that is there already counts by its shadow below the edge, not by what passes above it.
    term.below[0] = sign * first->ratio[i] > 0.0;
    term.below[1] = sign * second->ratio[j] > 0.0;
    const double u = first->bent * sqrt(form->spreads_m[0] * wavelength_m / WT_PI) / form->between_m;
    const double v = second->bent * sqrt(form->spreads_m[1] * wavelength_m / WT_PI) / form->between_m;
    term.cosines[0] = term.below[0] ? -u : u;
    term.cosines[1] = term.below[1] ? -v : v;
    term.waves.whole = image;
    term.waves.cosine = wt_cosine_of(mean.u, mean.v, term.cosines);
    wt_plane_sum sum;
    for (int face = 0; face < 2; ++face) {
      if (face == 0 || !wt_same_faces(plane->faces, plane->faces + 1))
        sum = wt_term_at_plane(&term, plane->faces + face, wavelength_m);
      *te = *te + wt_over(sum.te, image) * 0.5;
      *tm = *tm + wt_over(sum.tm, image) * 0.5;
    }
  }
}

// Two terms, i of the first edge and j of the second, with what the shared plane reflects: TE and TM.
inline void wt_terms_over_plane(const wt_pair_terms* first, const wt_pair_terms* second, int i, int j,
                                const wt_pair_form* form, const wt_shared_plane* plane, double wavelength_m,
                                wt_double2* te, wt_double2* tm) {
  const double x = first->argument[i], y = second->argument[j];
  const double r = form->coupling * (first->side[i] * second->side[j]), ratio = first->ratio[i] * second->ratio[j];
  const wt_double2 direct = wt_double_transition(x, y, r) * (double)plane->sides;
  const wt_double2 image = wt_double_transition(x, y, -r);
  wt_reflection_over_plane(first, second, i, j, form, plane, wavelength_m, r, image, te, tm);
  *te = (direct + wt_times(image, *te)) * ratio;
  *tm = (direct + wt_times(image, *tm)) * ratio;
}

// The pair over a plane that both edges bound. Waves along it come with their reflections, so the terms of reflection
// at either edge repeat those of incidence and do not count. between: the transfer from bends[0].to on.
inline wt_matrix wt_pair_over_plane(const wt_bend* bends, const wt_pair_terms* first, const wt_pair_terms* second,
                                    const wt_pair_form* form, const wt_transfer* between,
                                    const wt_shared_plane* plane) {
  const wt_double3 k = wt_cross3(between->rows.first, between->rows.second);
  const wt_basis polarizations = wt_polarizations(k, plane->normal);
  const wt_matrix identity = wt_diagonal(wt_real(1.0), wt_real(1.0));
  const wt_matrix come = wt_seen_in(between, polarizations), go = wt_turned(identity, polarizations, bends[1].from);
  wt_matrix sum = wt_diagonal(wt_real(0.0), wt_real(0.0));
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      wt_double2 te, tm;
      wt_terms_over_plane(first, second, i, j, form, plane, bends->corner.wavelength_m, &te, &tm);
      const wt_matrix arrived = wt_matrix_product(wt_diagonal(te, tm), wt_matrix_product(come, first->jump[i]));
      sum = wt_matrix_sum(sum, 1.0, wt_matrix_product(second->jump[j], wt_matrix_product(go, arrived)));
    }
  return sum;
}

// The pair without a plane between its edges.
inline wt_matrix wt_pair_in_open(const wt_bend* bends, const wt_pair_terms* first, const wt_pair_terms* second,
                                 const wt_pair_form* form, const wt_transfer* between) {
  const wt_matrix across = wt_seen_in(between, bends[1].from);
  wt_matrix sum = wt_diagonal(wt_real(0.0), wt_real(0.0));
  for (int j = 0; j < WT_BOUNDARIES; ++j) {
    wt_matrix arrived = wt_diagonal(wt_real(0.0), wt_real(0.0));
    for (int i = 0; i < WT_BOUNDARIES; ++i) {
      const double r = form->coupling * (first->side[i] * second->side[j]);
      const wt_double2 both =
          wt_double_transition(first->argument[i], second->argument[j], r) * (first->ratio[i] * second->ratio[j]);
      arrived = wt_matrix_sum(arrived, 1.0, wt_scaled(first->jump[i], both));
    }
    sum = wt_matrix_sum(sum, 1.0, wt_matrix_product(second->jump[j], wt_matrix_product(across, arrived)));
  }
  return sum;
}

// The map from bends[0].from to bends[1].to. known: what is known at each edge; between: what happens to the wave from
// bends[0].to on, until it comes to the second edge. A wave along a face to the first edge, or from the second, counts
// half, as at one edge.
inline wt_wave_map wt_diffract_at_pair(const wt_bend* bends, const wt_known_waves* known, const wt_pair_form* form,
                                       const wt_transfer* between, const wt_shared_plane* plane) {
  const wt_pair_terms first = wt_pair_terms_of(bends, known, form->distances_m[0], 0, plane->sides);
  const wt_pair_terms second = wt_pair_terms_of(bends + 1, known + 1, form->distances_m[1], 1, plane->sides);
  const double exterior[2] = {bends[0].corner.exterior, bends[1].corner.exterior};
  double share = 1.0;
  if (wt_grazes(bends[0].turn.in, exterior[0]) || (!plane->sides && wt_grazes(bends[0].turn.away, exterior[0])))
    share *= 0.5;
  if (wt_grazes(bends[1].turn.away, exterior[1]) || (!plane->sides && wt_grazes(bends[1].turn.in, exterior[1])))
    share *= 0.5;
  const wt_double2 amplitude = wt_times(wt_edge_amplitude(form->distances_m[0], bends[0].n),
                                        wt_edge_amplitude(form->distances_m[1], bends[1].n)) *
                               share;
  wt_wave_map out;
  out.from = bends[0].from;
  out.to = bends[1].to;
  out.matrix = wt_scaled(plane->sides ? wt_pair_over_plane(bends, &first, &second, form, between, plane)
                                      : wt_pair_in_open(bends, &first, &second, form, between),
                         amplitude);
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
