// SPDX-License-Identifier: Apache-2.0
// The wave that a piece of a body sends on by physical optics (facet.h), between the images of both ends. The piece is
// cut into similar triangles until the phase over each of them is linear, so it may be near an end; its polarisation is
// that of its middle. Physical optics is not reciprocal, so the matrix is the mean of those of both ways.
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

// A piece, its corners from its middle, and its images of both ends, seen from there; all in axes of the scene.
typedef struct {
  wt_double3 start, u, v;  // a corner, and the edges from there
  wt_double3 normal;       // outwards
  wt_double3 source, goal;
  double before_m, after_m;  // their distances
} wt_lit_facet;

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
  const double bend = 1.0 / fmax(f->before_m - radius, 1e-3 * radius) + 1.0 / fmax(f->after_m - radius, 1e-3 * radius);
  const double cuts = sqrt(square * bend * WT_PI / (WT_FACET_PHASE * wavelength_m));
  return cuts < (double)WT_MOST_CUTS ? (int)cuts + 1 : WT_MOST_CUTS;
}

// The mean of the wave over a triangle, with the phase of the way by the middle of the piece taken out. start, u, v: as
// in wt_lit_facet.
inline wt_double2 wt_part_of_facet(const wt_lit_facet* f, wt_double3 start, wt_double3 u, wt_double3 v,
                                   double wave_number) {
  const wt_double3 from_start = (u + v) / 3.0, middle = start + from_start;
  const wt_double3 in = middle - f->source, out = f->goal - middle;
  const double first_m = wt_length3(in), second_m = wt_length3(out);
  const wt_double3 slope = (in / first_m - out / second_m) * -wave_number;
  const double at_start = -wt_dot3(slope, from_start);
  const wt_double2 mean = wt_triangle_mean(at_start, at_start + wt_dot3(slope, u), at_start + wt_dot3(slope, v));
  const wt_double2 turn = wt_cos_sin(-wave_number * ((first_m - f->before_m) + (second_m - f->after_m)));
  return wt_times(mean, turn) * ((f->before_m / first_m) * (f->after_m / second_m));
}

// The integral of the wave over the piece, in m2.
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
  const double area = 0.5 * wt_length3(wt_cross3(f->u, f->v));
  return sum * (area / ((double)cuts * (double)cuts));
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

// The matrix from the field that arrives along k_in, in the basis `from`, to the one that leaves along k_out, in the
// basis `to`, in metres: times 1 / (before_m after_m) it is that of the path. before_m, after_m: lengths of the path on
// both sides of the point. Both ends are on one side of the facet.
inline wt_matrix wt_facet_wave(const wt_field_world* world, const WT_GLOBAL wt_target_point* point,
                               const WT_GLOBAL wt_target_facet* facet, wt_double3 k_in, wt_double3 k_out,
                               double before_m, double after_m, wt_basis from, wt_basis to) {
  wt_lit_facet f;
  f.start = wt_facet_corner(facet, point->rotation, 0);
  f.u = wt_facet_corner(facet, point->rotation, 1) - f.start;
  f.v = wt_facet_corner(facet, point->rotation, 2) - f.start;
  const wt_double3 across = wt_cross3(f.u, f.v);
  f.normal = across / wt_length3(across);
  f.source = k_in * -before_m;
  f.goal = k_out * after_m;
  f.before_m = before_m;
  f.after_m = after_m;
  const wt_matrix there = wt_facet_one_way(world, facet, f.normal, k_in, k_out, from, to);
  const wt_matrix back = wt_facet_one_way(world, facet, f.normal, -k_out, -k_in, to, from);
  wt_matrix mean;
  mean.m[0] = (there.m[0] + back.m[0]) * 0.5;
  mean.m[1] = (there.m[1] + back.m[2]) * 0.5;
  mean.m[2] = (there.m[2] + back.m[1]) * 0.5;
  mean.m[3] = (there.m[3] + back.m[3]) * 0.5;
  return wt_scaled(mean, wt_facet_amplitude(wt_facet_integral(&f, world->wavelength_m), world->wavelength_m));
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
#endif
