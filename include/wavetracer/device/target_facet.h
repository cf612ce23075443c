// SPDX-License-Identifier: Apache-2.0
// The wave that a piece of a body sends on by physical optics (facet.h), between the images of both ends. The piece is
// cut into similar triangles until the phase over each of them is linear, so it may be near an end; its polarisation is
// that of its middle. Physical optics is not reciprocal, so the matrix is the mean of those of both ways. A wave that
// bounces within a body has its mirrors before the piece on one way, and after it on the other one: each is one term of
// the mean, in a path of its own.
#ifndef WAVETRACER_DEVICE_TARGET_FACET_H
#define WAVETRACER_DEVICE_TARGET_FACET_H
#include "wavetracer/device/path_world.h"

#if WT_TARGETS && WT_FACETS
#include "wavetracer/device/facet.h"
#include "wavetracer/device/layers.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The phase that is left out within a triangle is at most this, in rad, as for bodies that stand alone. A piece is cut
// into the square of WT_MOST_CUTS triangles at most.
#define WT_FACET_PHASE 0.05
#define WT_MOST_CUTS 64

// The mirrors of its own body that a wave meets next to a piece.
#define WT_BOUNCED_BEFORE 1
#define WT_BOUNCED_AFTER 2

// An edge next to a piece, which a wave meets between an end and the piece.
typedef struct {
  wt_double3 along;  // unit vector
  double near_m;     // the distance of its point from the middle of the piece; 0 without an edge
} wt_edge_by_facet;

// The place that the wave on one side of a piece comes from or goes to, seen from the middle of the piece. Without an
// edge it is the image of an end. With one it is the point on the edge, and the end is across_m and down_m beyond that,
// away from the edge and along it: waves of an edge keep their angle with it.
typedef struct {
  wt_double3 at, along;
  double across_m, down_m;
  double length_m;  // the length from the end to the middle
  double near_m;    // the least radius of curvature of the wave
} wt_facet_side;

// A piece, with its corners from its middle, and what is on both sides of it; all in axes of the scene.
typedef struct {
  wt_double3 start, u, v;  // a corner, and the edges from there
  wt_double3 normal;       // outwards
  wt_facet_side before, after;
} wt_lit_facet;

// towards: the direction from the middle of the piece in which the side is.
inline wt_facet_side wt_side_of_facet(wt_double3 towards, double length_m, const wt_edge_by_facet* edge) {
  wt_facet_side side;
  side.length_m = length_m;
  side.near_m = edge->near_m > 0.0 ? edge->near_m : length_m;
  side.at = towards * side.near_m;
  side.along = edge->along;
  const double beyond_m = length_m - side.near_m, cosine = -wt_dot3(towards, edge->along);
  side.across_m = edge->near_m > 0.0 ? beyond_m * sqrt(fmax(0.0, 1.0 - cosine * cosine)) : 0.0;
  side.down_m = edge->near_m > 0.0 ? beyond_m * cosine : 0.0;
  return side;
}

// The length from the end to p, its slope there, and the amplitude of the wave.
typedef struct {
  wt_double3 slope;
  double length_m, amplitude;
} wt_facet_way;

inline wt_facet_way wt_way_to(const wt_facet_side* side, wt_double3 p) {
  wt_facet_way way;
  const wt_double3 from = p - side->at;
  const double direct_m = wt_length3(from);
  if (side->near_m == side->length_m) {
    way.length_m = direct_m;
    way.slope = from / direct_m;
    way.amplitude = 1.0 / direct_m;
    return way;
  }
  const double down = wt_dot3(from, side->along);
  const wt_double3 away = from - side->along * down;
  const double away_m = fmax(wt_length3(away), 1e-9 * side->near_m);
  const double across = away_m + side->across_m, below = down + side->down_m;
  way.length_m = sqrt(across * across + below * below);
  way.slope = away * (across / (way.length_m * away_m)) + side->along * (below / way.length_m);
  way.amplitude = 1.0 / sqrt(direct_m * way.length_m);
  return way;
}

// A corner in the axes of the scene; rotation: that of the target.
inline wt_double3 wt_facet_corner(const WT_GLOBAL wt_target_facet* facet, const WT_GLOBAL double* rotation,
                                  wt_uint corner) {
  const wt_double3 p = wt_vector(facet->corners + 3 * corner);
  return WT_DOUBLE3(wt_dot3(wt_vector(rotation), p), wt_dot3(wt_vector(rotation + 3), p),
                    wt_dot3(wt_vector(rotation + 6), p));
}

// The number of parts of an edge. The phase bends by at most pi r^2 (1 / d1 + 1 / d2) / wavelength within a triangle of
// radius r at these distances.
inline int wt_facet_cuts(const wt_lit_facet* f, double wavelength_m) {
  const wt_double3 second = f->start + f->u, third = f->start + f->v;
  const double square = fmax(wt_dot3(f->start, f->start), fmax(wt_dot3(second, second), wt_dot3(third, third)));
  const double radius = sqrt(square);
  const double bend =
      1.0 / fmax(f->before.near_m - radius, 1e-3 * radius) + 1.0 / fmax(f->after.near_m - radius, 1e-3 * radius);
  const double cuts = sqrt(square * bend * WT_PI / (WT_FACET_PHASE * wavelength_m));
  return cuts < (double)WT_MOST_CUTS ? (int)cuts + 1 : WT_MOST_CUTS;
}

// The mean of the wave over a triangle, with the phase of the way by the middle of the piece taken out. start, u, v: as
// in wt_lit_facet.
inline wt_double2 wt_part_of_facet(const wt_lit_facet* f, wt_double3 start, wt_double3 u, wt_double3 v,
                                   double wave_number) {
  const wt_double3 from_start = (u + v) / 3.0, middle = start + from_start;
  const wt_facet_way in = wt_way_to(&f->before, middle), out = wt_way_to(&f->after, middle);
  const wt_double3 slope = (in.slope + out.slope) * -wave_number;
  const double at_start = -wt_dot3(slope, from_start);
  const wt_double2 mean = wt_triangle_mean(at_start, at_start + wt_dot3(slope, u), at_start + wt_dot3(slope, v));
  const double longer_m = (in.length_m - f->before.length_m) + (out.length_m - f->after.length_m);
  return wt_times(mean, wt_cos_sin(-wave_number * longer_m)) * (in.amplitude * out.amplitude);
}

// The integral of the wave over the piece, in m2, with the amplitude 1 in its middle.
inline wt_double2 wt_facet_integral(const wt_lit_facet* f, double wavelength_m) {
  const int cuts = wt_facet_cuts(f, wavelength_m);
  const double wave_number = 2.0 * WT_PI / wavelength_m;
  const wt_double3 u = f->u / (double)cuts, v = f->v / (double)cuts;
  wt_double2 sum = WT_DOUBLE2(0.0, 0.0);
  for (int i = 0; i < cuts; ++i)
    for (int j = 0; i + j < cuts; ++j) {
      const wt_double3 start = f->start + u * (double)i + v * (double)j;
      sum = sum + wt_part_of_facet(f, start, u, v, wave_number);
      if (i + j + 1 < cuts) sum = sum + wt_part_of_facet(f, start + u + v, -u, -v, wave_number);
    }
  const wt_double3 origin = WT_DOUBLE3(0.0, 0.0, 0.0);
  const double middle = wt_way_to(&f->before, origin).amplitude * wt_way_to(&f->after, origin).amplitude;
  const double area = 0.5 * wt_length3(wt_cross3(f->u, f->v));
  return sum * (area / (middle * ((double)cuts * (double)cuts)));
}

inline wt_slab wt_facet_reflection(const wt_field_world* world, const WT_GLOBAL wt_target_facet* facet,
                                   wt_double3 normal, wt_double3 k) {
  const wt_material material = world->materials[facet->material];
  const double along = wt_dot3(k, normal);
  wt_layers layers = wt_no_layers();
  wt_double2 permittivity = WT_DOUBLE2(material.permittivity[0], material.permittivity[1]);
#if WT_LAYERS
  layers = wt_layers_of(world->materials, material.layers, (along > 0.0) != (facet->turned != 0));
  permittivity = wt_met_permittivity(layers, permittivity);
#endif
  return wt_wall_coefficients(layers, permittivity, fmin(fabs(along), 1.0), material.thickness_m, world->wavelength_m);
}

// The matrix of wt_facet_matrix with columns in the basis `from`.
inline wt_matrix wt_facet_one_way(const wt_field_world* world, const WT_GLOBAL wt_target_facet* facet,
                                  wt_double3 outwards, wt_double3 k_in, wt_double3 k_out, wt_basis from, wt_basis to) {
  const wt_slab slab = wt_facet_reflection(world, facet, outwards, k_in);
  const wt_double3 lit = wt_dot3(k_in, outwards) > 0.0 ? -outwards : outwards;
  const wt_matrix turned = wt_turned(wt_diagonal(wt_real(1.0), wt_real(1.0)), from, wt_polarizations(k_in, lit));
  return wt_matrix_product(wt_facet_matrix(k_in, k_out, lit, slab.reflection_te, slab.reflection_tm, to), turned);
}

// The waves on both sides of a piece: lengths of the path there, edges next to the piece, and mirrors of its own body
// (WT_BOUNCED_BEFORE, WT_BOUNCED_AFTER, or 0).
typedef struct {
  double before_m, after_m;
  wt_edge_by_facet edge_before, edge_after;
  int bounced;
} wt_beside_facet;

// The vertex next to vertex k, before it (way -1) or after it (1), past transmissions; the depth of the path where
// there is none.
inline wt_uint wt_beside_vertex(const wt_path* path, wt_uint k, int way) {
  for (wt_uint i = k + way; i < path->depth; i += way)  // before the first vertex it is larger than any
    if (wt_kind(path, i) != WT_STEP_TRANSMISSION) return i;
  return path->depth;
}

inline wt_edge_by_facet wt_edge_beside(const wt_field_world* world, const wt_path* path, wt_uint k, wt_uint beside) {
  wt_edge_by_facet edge;
  edge.along = WT_DOUBLE3(0.0, 0.0, 0.0);
  edge.near_m = 0.0;
  if (beside < path->depth && wt_kind(path, beside) == WT_STEP_DIFFRACTION) {
    edge.along = wt_vector(world->wedges[wt_number(path, beside)].along);
    edge.near_m = wt_length3(wt_vertex(path, beside) - wt_vertex(path, k));
  }
  return edge;
}

inline int wt_mirrors_own(const wt_field_world* world, const wt_path* path, wt_uint beside, wt_uint instance) {
  return beside < path->depth && wt_kind(path, beside) == WT_STEP_REFLECTION &&
         world->surfaces[wt_number(path, beside)].instance == instance;
}

// The neighbours of the piece at vertex k.
inline wt_beside_facet wt_beside_piece(const wt_field_world* world, const wt_path* path, wt_uint k, double before_m,
                                       double after_m) {
  const wt_uint before = wt_beside_vertex(path, k, -1), after = wt_beside_vertex(path, k, 1);
  const wt_uint instance = world->targets[wt_number(path, k)].instance;
  wt_beside_facet out;
  out.before_m = before_m;
  out.after_m = after_m;
  out.edge_before = wt_edge_beside(world, path, k, before);
  out.edge_after = wt_edge_beside(world, path, k, after);
  out.bounced = wt_mirrors_own(world, path, before, instance)  ? WT_BOUNCED_BEFORE
                : wt_mirrors_own(world, path, after, instance) ? WT_BOUNCED_AFTER
                                                               : 0;
  return out;
}

// The matrix from the field that arrives along k_in, in the basis `from`, to the one that leaves along k_out, in the
// basis `to`, in metres: times the spreading of the waves on both sides it is that of the path. Both ends are on one
// side of the facet.
inline wt_matrix wt_facet_wave(const wt_field_world* world, const WT_GLOBAL wt_target_point* point,
                               const WT_GLOBAL wt_target_facet* facet, wt_double3 k_in, wt_double3 k_out,
                               const wt_beside_facet* beside, wt_basis from, wt_basis to) {
  wt_lit_facet f;
  f.start = wt_facet_corner(facet, point->rotation, 0);
  f.u = wt_facet_corner(facet, point->rotation, 1) - f.start;
  f.v = wt_facet_corner(facet, point->rotation, 2) - f.start;
  const wt_double3 across = wt_cross3(f.u, f.v);
  f.normal = across / wt_length3(across);
  f.before = wt_side_of_facet(-k_in, beside->before_m, &beside->edge_before);
  f.after = wt_side_of_facet(k_out, beside->after_m, &beside->edge_after);
  wt_matrix mean = wt_diagonal(wt_real(0.0), wt_real(0.0));
  if (beside->bounced != WT_BOUNCED_AFTER) mean = wt_facet_one_way(world, facet, f.normal, k_in, k_out, from, to);
  if (beside->bounced != WT_BOUNCED_BEFORE) {
    const wt_matrix back = wt_facet_one_way(world, facet, f.normal, -k_out, -k_in, to, from);
    mean.m[0] = mean.m[0] + back.m[0];
    mean.m[1] = mean.m[1] + back.m[2];
    mean.m[2] = mean.m[2] + back.m[1];
    mean.m[3] = mean.m[3] + back.m[3];
  }
  const wt_double2 amplitude = wt_facet_amplitude(wt_facet_integral(&f, world->wavelength_m), world->wavelength_m);
  return wt_scaled(mean, amplitude * 0.5);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
#endif
