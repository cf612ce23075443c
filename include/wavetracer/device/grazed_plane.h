// SPDX-License-Identifier: Apache-2.0
// The reflection of a plane between two edges that bound it. A term of a pair of edges (edge_pair.h) counts the waves
// whose heights over the edges, u and v, are on one side of each: above, or below an edge where the wave is there
// already. The plane reflects waves above both edges at their mean cosine of incidence, a complex number. Waves below
// an edge would meet it from below; they are the missing part of the wave that the other edge diffracts alone, or of
// the ray, which are paths of their own. So their sum is that of those paths less the waves above, and where a path
// comes to be seen the pair has lost just what the path has.
#ifndef WAVETRACER_DEVICE_GRAZED_PLANE_H
#define WAVETRACER_DEVICE_GRAZED_PLANE_H
#include "wavetracer/device/corner.h"
#include "wavetracer/device/double_transition.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// A plane along which the leg between the edges runs.
typedef struct {
  int sides;  // 0: there is none; 2: of a sheet that ends at both edges
  wt_double3 normal;
  wt_wedge_face faces[2];  // the plane at either edge
} wt_shared_plane;

// Waves of one term: their integral, and their mean cosine of incidence on the plane.
typedef struct {
  wt_double2 whole, cosine;
} wt_grazing_waves;

// Describes the waves of a term: the integral over u, v > 0 of double_transition.h with the arguments x, y and r.
typedef struct {
  double x, y, r;
  double cosines[2];  // cosines of incidence, for each unit of u and of v; negative below the edge
  int below[2];       // is the term one of the waves below the edge?
  wt_grazing_waves waves;
} wt_grazing_term;

// The integral of waves times the coefficients of the plane.
typedef struct {
  wt_double2 te, tm;
} wt_plane_sum;

inline wt_double2 wt_cosine_of(wt_double2 u, wt_double2 v, const double* cosines) {
  return u * cosines[0] + v * cosines[1];
}

// All waves of one side of an edge, whose term has the argument x, whatever their height over the other edge, y. s: the
// argument of the wave that the edge diffracts alone; negative where that wave is on the other side of its boundary.
inline wt_grazing_waves wt_waves_over_one(double x, double y, double r, const double* cosines, double* s) {
  const double c = sqrt((1.0 - r) * (1.0 + r));
  *s = (x + r * y) / c;
  const wt_double2 g = wt_transition_of_any(*s), line = WT_EIGHTH_TURN * (2.0 / (c * WT_INV_SQRT_PI));
  const wt_double2 u = wt_over(wt_real(1.0) - g * *s, g) * (1.0 / c);
  wt_grazing_waves out;
  out.whole = wt_times(wt_times(line, wt_cos_sin(y * y)), g);
  out.cosine = wt_cosine_of(u, u * r - wt_real(y), cosines);
  return out;
}

// All waves of either side of both edges: the ray.
inline wt_grazing_waves wt_waves_of_ray(const wt_grazing_term* term) {
  const double x = term->x, y = term->y, r = term->r, c2 = (1.0 - r) * (1.0 + r);
  const wt_double2 phase = wt_cos_sin((x * x + 2.0 * r * x * y + y * y) / c2);
  wt_grazing_waves out;
  out.whole = WT_DOUBLE2(-phase.y, phase.x) * (4.0 * WT_PI / sqrt(c2));
  out.cosine = wt_cosine_of(wt_real(-(x + r * y) / c2), wt_real(-(y + r * x) / c2), term->cosines);
  return out;
}

inline wt_grazing_waves wt_less(wt_grazing_waves all, wt_grazing_waves part) {
  wt_grazing_waves out;
  out.whole = all.whole - part.whole;
  out.cosine = wt_over(wt_times(all.whole, all.cosine) - wt_times(part.whole, part.cosine), out.whole);
  return out;
}

inline wt_plane_sum wt_sum_less(wt_plane_sum a, wt_plane_sum b) {
  a.te = a.te - b.te;
  a.tm = a.tm - b.tm;
  return a;
}

inline wt_plane_sum wt_sum_between(wt_plane_sum a, wt_plane_sum b, double share) {
  a.te = a.te + (b.te - a.te) * share;
  a.tm = a.tm + (b.tm - a.tm) * share;
  return a;
}

// Waves at their mean cosine; below the plane, mirrored about the ray of the cosine `lit`.
inline wt_plane_sum wt_waves_at_plane(const wt_wedge_face* face, wt_grazing_waves waves, double lit, int mirrored,
                                      double wavelength_m) {
  const wt_slab slab = wt_face_slab_of(face, fmax(lit, 0.0), waves.cosine, mirrored, wavelength_m);
  wt_plane_sum out;
  out.te = wt_times(waves.whole, slab.reflection_te);
  out.tm = wt_times(waves.whole, slab.reflection_tm);
  return out;
}

// Near a boundary 0, 1 far from it.
inline double wt_far_from(double argument) { return argument * argument / (1.0 + argument * argument); }

// The waves `part` below the one edge and above the other; all: of both sides of the former, whose argument is x.
inline wt_plane_sum wt_sum_below_one(const wt_wedge_face* face, wt_grazing_waves all, wt_grazing_waves part, double x,
                                     double wavelength_m) {
  const wt_plane_sum whole = wt_waves_at_plane(face, all, 0.0, 0, wavelength_m);
  const wt_plane_sum above = wt_waves_at_plane(face, wt_less(all, part), 0.0, 0, wavelength_m);
  const wt_plane_sum alone = wt_waves_at_plane(face, part, 0.0, part.cosine.x < 0.0, wavelength_m);
  return wt_sum_between(wt_sum_less(whole, above), alone, wt_far_from(x));
}

// The rest of the wave that an edge diffracts alone, `one` below it, without the waves above the other edge. rest:
// all waves above that; s: see wt_waves_over_one; x: the argument of the edge.
inline wt_plane_sum wt_sum_of_one(const wt_grazing_term* term, const wt_wedge_face* face, wt_grazing_waves ray,
                                  wt_grazing_waves one, wt_grazing_waves rest, double s, double x,
                                  double wavelength_m) {
  wt_plane_sum whole;
  if (s >= 0.0)
    whole = wt_waves_at_plane(face, one, ray.cosine.x, 1, wavelength_m);
  else
    whole = wt_sum_less(wt_waves_at_plane(face, ray, 0.0, 0, wavelength_m),
                        wt_waves_at_plane(face, wt_less(ray, one), 0.0, 0, wavelength_m));
  return wt_sum_less(whole, wt_sum_below_one(face, rest, wt_less(one, term->waves), x, wavelength_m));
}

inline wt_plane_sum wt_sum_below_both(const wt_grazing_term* term, const wt_wedge_face* face, double wavelength_m) {
  const double x = term->x, y = term->y, other[2] = {term->cosines[1], term->cosines[0]};
  double s, t;
  const wt_grazing_waves ray = wt_waves_of_ray(term);
  const wt_grazing_waves first = wt_waves_over_one(x, y, term->r, term->cosines, &s);
  const wt_grazing_waves second = wt_waves_over_one(y, x, term->r, other, &t);
  const wt_plane_sum by_first = wt_sum_of_one(term, face, ray, first, wt_less(ray, second), s, x, wavelength_m);
  const wt_plane_sum by_second = wt_sum_of_one(term, face, ray, second, wt_less(ray, first), t, y, wavelength_m);
  const wt_plane_sum alone = wt_waves_at_plane(face, term->waves, ray.cosine.x, 1, wavelength_m);
  const double squares = x * x + y * y;
  const wt_plane_sum both = wt_sum_between(by_second, by_first, squares > 0.0 ? x * x / squares : 0.5);
  return wt_sum_between(both, alone, fmin(wt_far_from(x), wt_far_from(y)));
}

// The sum of a term.
inline wt_plane_sum wt_term_at_plane(const wt_grazing_term* term, const wt_wedge_face* face, double wavelength_m) {
  const double other[2] = {term->cosines[1], term->cosines[0]};
  double s;
  if (term->below[0] && term->below[1]) return wt_sum_below_both(term, face, wavelength_m);
  if (term->below[0])
    return wt_sum_below_one(face, wt_waves_over_one(term->y, term->x, term->r, other, &s), term->waves, term->x,
                            wavelength_m);
  if (term->below[1])
    return wt_sum_below_one(face, wt_waves_over_one(term->x, term->y, term->r, term->cosines, &s), term->waves, term->y,
                            wavelength_m);
  return wt_waves_at_plane(face, term->waves, 0.0, 0, wavelength_m);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
