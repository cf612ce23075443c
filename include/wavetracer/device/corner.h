// SPDX-License-Identifier: Apache-2.0
// The two faces of an edge as mirrors: the waves that they reflect, or transmit, before these meet the edge.
// Local axes are x along face 0, y along its normal, and z along the edge.
#ifndef WAVETRACER_DEVICE_CORNER_H
#define WAVETRACER_DEVICE_CORNER_H
#include "wavetracer/device/layers.h"
#include "wavetracer/device/transfer.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

#define WT_GRAZING_RAD 1e-9

// The material of a face. An infinite permittivity.x means a perfect conductor.
typedef struct {
  wt_double2 permittivity;  // with layers: that of the one that a wave meets first
  double thickness_m;
  double zone;  // wt_zone_cosine of the path
#if WT_LAYERS
  wt_layers layers;
#endif
} wt_wedge_face;

inline wt_layers wt_face_layers(const wt_wedge_face* face) {
#if WT_LAYERS
  return face->layers;
#else
  return wt_no_layers();
#endif
}

// Do two faces reflect alike?
inline int wt_same_faces(const wt_wedge_face* a, const wt_wedge_face* b) {
  const wt_layers one = wt_face_layers(a), other = wt_face_layers(b);
  return a->permittivity.x == b->permittivity.x && a->permittivity.y == b->permittivity.y &&
         a->thickness_m == b->thickness_m && a->zone == b->zone && one.first == other.first &&
         one.count == other.count && one.from_last == other.from_last;
}

typedef struct {
  double exterior;
  wt_double2 turn;  // cosine and sine of that angle
  wt_wedge_face faces[2];
  double wavelength_m;
} wt_corner;

// Selections keep a corner in registers, where places in its arrays would not.
inline wt_wedge_face wt_corner_face(const wt_corner* corner, int face) {
  return face ? corner->faces[1] : corner->faces[0];
}
inline wt_double3 wt_corner_normal(const wt_corner* corner, int face) {
  return face ? WT_DOUBLE3(corner->turn.y, -corner->turn.x, 0.0) : WT_DOUBLE3(0.0, 1.0, 0.0);
}

// A plane wave that comes to the corner, from the side of the edge on which its source lies.
typedef struct {
  wt_double3 k;
  wt_basis coming;
} wt_corner_wave;

// The edge-fixed basis of a wave that leaves the edge, and that of one that comes to it; (beta, phi, k) is
// right-handed.
inline wt_basis wt_leaving(wt_double3 along, wt_double3 k) {
  wt_basis out;
  out.second = wt_normalized(wt_cross3(along, k));
  out.first = wt_cross3(out.second, k);
  return out;
}
inline wt_basis wt_coming(wt_double3 along, wt_double3 k) { return wt_leaving(-along, k); }

// The matrix of the wave in the other direction, between the edge-fixed bases of that direction: beta changes its sign.
inline wt_matrix wt_other_way(wt_matrix m) {
  const wt_double2 other = m.m[1];
  m.m[1] = -m.m[2];
  m.m[2] = -other;
  return m;
}

inline wt_slab wt_face_slab(const wt_wedge_face* face, double cos_theta, double wavelength_m) {
  if (fabs(face->permittivity.x) == WT_INFINITY || fabs(face->permittivity.y) == WT_INFINITY) {
    wt_slab out;
    out.reflection_te = wt_real(-1.0);
    out.reflection_tm = wt_real(1.0);
    out.transmission_te = out.transmission_tm = wt_real(0.0);
    return out;
  }
  return wt_wall_coefficients(wt_face_layers(face), face->permittivity,
                              wt_cosine_of_zone(face->permittivity, cos_theta, face->zone), face->thickness_m,
                              wavelength_m);
}

// turn: cosine and sine of the azimuth of the source; cosine: that of the angle between the wave and the edge; sine:
// that of the same angle, not negative.
inline wt_corner_wave wt_wave_from(wt_double2 turn, double cosine, double sine) {
  wt_corner_wave wave;
  wave.k = WT_DOUBLE3(-sine * turn.x, -sine * turn.y, cosine);
  wave.coming = wt_coming(WT_DOUBLE3(0.0, 0.0, 1.0), wave.k);
  return wave;
}

// The coefficient of a plane near grazing, (cosine - z) / (cosine + z), at a complex cosine of incidence. z follows
// from the known coefficient at the real cosine `size`.
inline wt_double2 wt_at_complex_cosine(wt_double2 coefficient, wt_double2 cosine, double size) {
  const wt_double2 up = wt_times(cosine, wt_real(1.0) + coefficient);
  const wt_double2 down = (wt_real(1.0) - coefficient) * size;
  return wt_over(up - down, up + down);
}

// Reflection at a complex cosine. Waves that graze a face at some mean angle come with a Gaussian in which the cosine
// is complex.
inline wt_slab wt_face_slab_at(const wt_wedge_face* face, wt_double2 cosine, double wavelength_m) {
  const double whole = wt_size(cosine), size = fmin(fmax(whole, 1e-12), 1.0);
  const wt_double2 turned = whole > 0.0 ? cosine * (size / whole) : wt_real(size);
  wt_slab slab = wt_face_slab(face, size, wavelength_m);
  slab.reflection_te = wt_at_complex_cosine(slab.reflection_te, turned, size);
  slab.reflection_tm = wt_at_complex_cosine(slab.reflection_tm, turned, size);
  return slab;
}

// The coefficient, or one of its direction whose size is 1: a face reflects no more than it gets.
inline wt_double2 wt_no_gain(wt_double2 coefficient) { return coefficient / fmax(wt_size(coefficient), 1.0); }

// Coefficients of waves at the complex cosine `there`; with `mirrored` those of hidden waves beside a ray of the cosine
// `lit`, which differ from those of the ray by as much as the waves on its other side do, with the other sign.
inline wt_slab wt_face_slab_of(const wt_wedge_face* face, double lit, wt_double2 there, int mirrored,
                               double wavelength_m) {
  wt_slab slab = wt_face_slab_at(face, mirrored ? wt_real(2.0 * lit) - there : there, wavelength_m);
  slab.reflection_te = wt_no_gain(slab.reflection_te);
  slab.reflection_tm = wt_no_gain(slab.reflection_tm);
  if (!mirrored) return slab;
  const wt_slab ray = wt_face_slab(face, lit, wavelength_m);
  slab.reflection_te = ray.reflection_te * 2.0 - slab.reflection_te;
  slab.reflection_tm = ray.reflection_tm * 2.0 - slab.reflection_tm;
  return slab;
}

// The reflection at a cosine of incidence, where the waves that count on one side of a boundary of reflection are not
// those of the ray at the edge: on the mean, they meet the face at a cosine that is larger by `shift`, a complex
// number. On the other side, where the face reflects a ray with the cosine `lit`, what the edge hides of that ray's
// surroundings counts, mirrored about the ray: as much as `mirrored` says, which is 1 on the boundary and 0 far from
// it, or where the face reflects no ray. On the boundary both sides leave just the ray. No cosine is negative.
inline wt_slab wt_face_slab_beside(const wt_wedge_face* face, double cosine, double lit, wt_double2 shift,
                                   double mirrored, double wavelength_m) {
  if (shift.x == 0.0 && shift.y == 0.0) return wt_face_slab(face, cosine, wavelength_m);
  wt_double2 there = wt_real(cosine) + shift;
  there.x = mirrored > 0.0 ? fmin(there.x, 2.0 * lit) : fmax(there.x, 0.0);
  wt_slab slab = wt_face_slab_of(face, lit, there, mirrored > 0.0, wavelength_m);
  if (mirrored == 0.0) return slab;
  const wt_slab far = wt_face_slab(face, cosine, wavelength_m);
  slab.reflection_te = slab.reflection_te * mirrored + far.reflection_te * (1.0 - mirrored);
  slab.reflection_tm = slab.reflection_tm * mirrored + far.reflection_tm * (1.0 - mirrored);
  return slab;
}

// The matrix from (beta', phi') to (beta, phi) of a wave that a face reflects. te, tm: the coefficients of the face;
// turn: cosine and sine of the azimuth of the source from this face; cosine: that of the angle between the wave and the
// edge. The unit vector normal to the plane of incidence has the components -turn.x / S along beta' and cosine turn.y /
// S along phi', S^2 = turn.x^2 + (cosine turn.y)^2. At normal incidence there is no such plane, and tm is -te.
inline wt_matrix wt_reflection_between(int face, wt_double2 turn, double cosine, wt_double2 te, wt_double2 tm) {
  const double along = cosine * turn.y, square = turn.x * turn.x + along * along, share = 1.0 / square;
  const int plane = square > 1e-16;
  const double beta = plane ? turn.x * turn.x * share : 1.0, phi = plane ? along * along * share : 0.0;
  const wt_double2 mixed = (te + tm) * (plane ? turn.x * along * share : 0.0);
  wt_matrix out;
  out.m[0] = tm * phi - te * beta;
  out.m[1] = face ? -mixed : mixed;
  out.m[2] = face ? mixed : -mixed;
  out.m[3] = te * phi - tm * beta;
  return out;
}

// The wave reflected at one face. turn, cosine: see wt_reflection_between; sine: that of the angle between the wave and
// the edge; lit, shift, mirrored: see wt_face_slab_beside.
WT_CALLED wt_matrix wt_reflected_wave(wt_wedge_face material, int face, wt_double2 turn, double cosine, double sine,
                                      double lit, wt_double2 shift, double mirrored, double wavelength_m) {
  const wt_slab slab =
      wt_face_slab_beside(&material, fmin(sine * fabs(turn.y), 1.0), lit, shift, mirrored, wavelength_m);
  return wt_reflection_between(face, turn, cosine, slab.reflection_te, slab.reflection_tm);
}

// The wave as a matrix from (beta', phi') to (beta, phi): reflected `count` times, or let through by as many faces; it
// meets face `first`, then the other one, and so on in turn.
WT_CALLED wt_matrix wt_met(const wt_corner* corner, const wt_corner_wave* wave, int first, int count, int straight) {
  // In a wave that leaves, both vectors of the basis are reversed.
  if (count == 0) return wt_diagonal(wt_real(-1.0), wt_real(-1.0));
  wt_double3 k = wave->k;
  wt_transfer transfer = wt_transfer_from(wave->coming);
  for (int i = 0; i < count; ++i) {
    const int face = first != (i % 2 == 1);
    const wt_double3 normal = wt_corner_normal(corner, face);
    const wt_double3 out = straight ? k : wt_mirrored(k, normal);
    const wt_wedge_face material = wt_corner_face(corner, face);
    const wt_slab slab = wt_face_slab(&material, fmin(fabs(wt_dot3(k, normal)), 1.0), corner->wavelength_m);
    if (straight)
      wt_meet(&transfer, k, out, normal, slab.transmission_te, slab.transmission_tm);
    else
      wt_meet(&transfer, k, out, normal, slab.reflection_te, slab.reflection_tm);
    k = out;
  }
  return wt_seen_in(&transfer, wt_leaving(WT_DOUBLE3(0.0, 0.0, 1.0), k));
}

// The wave after |image| reflections: at faces 0, 1, 0, ... if image < 0, at 1, 0, 1, ... if image > 0.
inline wt_matrix wt_image_wave(const wt_corner* corner, const wt_corner_wave* wave, int image) {
  return wt_met(corner, wave, image > 0, image < 0 ? -image : image, 0);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
