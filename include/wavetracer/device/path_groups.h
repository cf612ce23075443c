// SPDX-License-Identifier: Apache-2.0
// The geometrical waves that a path belongs to, and its share in each of them (groups in wavetracer/paths.hpp). A path
// belongs to the wave of its own steps, and in part to the waves of the same steps that have nothing in place of an
// edge, or a reflection at one of its faces. Such a wave groups the paths that are diffracted at its boundaries even if
// it does not reach the receiver itself; so nothing jumps where it begins to. With several edges their shares are
// multiplied. Steps are compared by planes, since neighbours in one plane reflect alike, and without transmissions,
// which do not change the way of a wave. A path over a tile or a target is a wave of its own for each tile and
// each point; it may have an edge beside that, whose share is that of its side.
#ifndef WAVETRACER_DEVICE_PATH_GROUPS_H
#define WAVETRACER_DEVICE_PATH_GROUPS_H
#include "wavetracer/device/path_rows.h"

#ifndef WT_DIFFRACTS  // the most diffractions of a path
#define WT_DIFFRACTS 8
#endif

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The number of waves that are kept from edge to edge, those with the largest weights.
#define WT_WAVES_KEPT (WT_DIFFRACTS > 1 ? 16 : 4)
// The detour, in wavelengths, from which on a diffracted wave shares a wave with no other.
#define WT_MOST_DETOUR 2.0
// The things that may be in place of an edge in another wave: the edge itself, nothing, a reflection at face 0 or at
// face 1.
#define WT_IN_PLACES 4

// Waves by the hashes of their steps, in the order of their weights; the squares of all weights add up to 1.
typedef struct {
  wt_ulong keys[WT_WAVES_KEPT];
  double weights[WT_WAVES_KEPT];
  wt_uint count;
} wt_waves;

inline wt_ulong wt_mixed(wt_ulong hash, wt_ulong value) {  // the finisher of SplitMix64
  hash = (hash ^ value) + 0x9E3779B97F4A7C15ul;
  hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9ul;
  hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBul;
  return hash ^ (hash >> 31);
}

// Adds a wave. If it is there already, the larger weight of both together replaces both. If there are too many, the one
// with the smallest weight is lost.
inline void wt_add_wave(wt_waves* waves, wt_ulong key, double weight) {
  wt_uint at = 0;
  while (at < waves->count && waves->keys[at] != key) ++at;
  if (at < waves->count) weight = sqrt(waves->weights[at] * waves->weights[at] + weight * weight);
  if (at == WT_WAVES_KEPT && waves->weights[--at] >= weight) return;
  if (at == waves->count) ++waves->count;
  for (; at > 0 && waves->weights[at - 1] < weight; --at) {
    waves->keys[at] = waves->keys[at - 1];
    waves->weights[at] = waves->weights[at - 1];
  }
  waves->keys[at] = key;
  waves->weights[at] = weight;
}

// 1 without a detour, 0 from WT_MOST_DETOUR on, and smooth in between. detour: in wavelengths.
inline double wt_share_at(double detour) {
  const double part = fmin(detour / WT_MOST_DETOUR, 1.0);
  return (1.0 - part * part) * (1.0 - part * part);
}

// The share of a diffracted wave in each wave that passes the edge straight or is reflected at one of its faces: an
// amplitude for each thing in place of the edge; their squares add up to 1. At a shadow boundary both leave the edge in
// one direction, and they are one wave. Away from it the detour over the edge grows, and from two wavelengths on they
// are two waves, whose powers add up. Directions alone define boundaries: the difference of two unit vectors, squared,
// is 4 sin^2(epsilon / 2), with epsilon as in utd.h, and the detour is that times half of the distance parameter.
// Shares are continuous in all of these, except where two boundaries meet.
// k_in, k_out: unit vectors before and after the edge. before_m, after_m: unfolded lengths from the edge to the ends.
inline void wt_edge_shares(const WT_GLOBAL wt_wedge* wedge, wt_double3 k_in, wt_double3 k_out, double before_m,
                           double after_m, double wavelength_m, double* shares) {
  const wt_double3 along = wt_vector(wedge->along), normal = wt_vector(wedge->normal);
  const wt_double3 across_in = k_in - along * wt_dot3(k_in, along), across_out = k_out - along * wt_dot3(k_out, along);
  const double sine2 = wt_dot3(across_in, across_in), sine2_out = wt_dot3(across_out, across_out);
  shares[0] = 1.0;
  for (int i = 1; i < WT_IN_PLACES; ++i) shares[i] = 0.0;
  if (!(sine2 > 1e-18) || !(sine2_out > 1e-18) || !(before_m > 0.0) || !(after_m > 0.0)) return;
  const wt_double3 in = across_in / sqrt(sine2), out = across_out / sqrt(sine2_out);
  const double scale = 0.5 * before_m * after_m / (before_m + after_m) * sine2 / wavelength_m;
  double part[WT_IN_PLACES];
  double largest = 0.0, sum = 0.0;  // largest: the share of the nearest boundary, as if it were the only one
  for (int i = 1; i < WT_IN_PLACES; ++i) {
    wt_double3 other = in;
    part[i] = 0.0;
    if (i > 1) {
      const wt_double3 n = i == 2 ? normal : wt_vector(wedge->face) * wedge->sine - normal * wedge->cosine;
      if (wt_dot3(in, n) > 0.0 && wt_dot3(out, n) < 0.0) continue;  // behind the face
      other = in - n * (2.0 * wt_dot3(in, n));
    }
    const wt_double3 apart = out - other;
    const double detour = scale * wt_dot3(apart, apart), near = wt_share_at(detour);
    part[i] = near / fmax(detour, 1e-12);
    largest = fmax(largest, near);
    sum += part[i] * part[i];
  }
  shares[0] = sqrt((1.0 - largest) * (1.0 + largest));
  if (sum > 0.0)
    for (int i = 1; i < WT_IN_PLACES; ++i) shares[i] = largest * part[i] / sqrt(sum);
}

// Moves each wave of *waves past an edge: it becomes each of the waves that it may belong to there.
inline void wt_waves_past_edge(const WT_GLOBAL wt_wedge* wedge, wt_uint step, const double* shares, wt_waves* waves) {
  wt_waves next;
  next.count = 0;
  for (int place = 0; place < WT_IN_PLACES; ++place)
    for (wt_uint i = 0; shares[place] > 0.0 && i < waves->count; ++i) {
      const wt_ulong key = waves->keys[i];
      const wt_uint other = place == 0 ? step : WT_STEP_REFLECTION | wedge->planes[place > 2];
      wt_add_wave(&next, place == 1 ? key : wt_mixed(key, other), waves->weights[i] * shares[place]);
    }
  *waves = next;
}

// Finds the waves that a path belongs to. wedges: in the coordinates of the path. planes_of: for each surface, the
// surface that stands for its plane. Returns whether the path is diffracted.
inline wt_uint wt_waves_of(const wt_path* path, const WT_GLOBAL wt_wedge* wedges, const WT_GLOBAL wt_uint* planes_of,
                           double wavelength_m, wt_waves* waves) {
  wt_uint bends = 0;
  for (wt_uint k = 0; k < path->depth; ++k) bends |= (wt_step(path, k) & WT_STEP_KIND) == WT_STEP_DIFFRACTION;
  double length_m = bends ? wt_section_length(path, 0, path->from) : 0.0, since_m = 0.0;
  wt_double3 from = path->from;
  waves->count = 0;
  wt_add_wave(waves, 0, 1.0);
  for (wt_uint k = 0; k < path->depth; ++k) {
    const wt_uint step = wt_step(path, k), kind = step & WT_STEP_KIND, number = step & ~WT_STEP_KIND;
    const wt_double3 at = wt_vertex(path, k), leg = at - from;
    from = at;
    if (bends) since_m += wt_length3(leg);
    if (kind == WT_STEP_TARGET || kind == WT_STEP_SCATTERING) {
      for (wt_uint i = 0; i < waves->count; ++i) waves->keys[i] = wt_mixed(waves->keys[i], step);
      if (bends) length_m = wt_section_length(path, k + 1, at);
      since_m = 0.0;
    }
    if (kind == WT_STEP_REFLECTION)
      for (wt_uint i = 0; i < waves->count; ++i)
        waves->keys[i] = wt_mixed(waves->keys[i], WT_STEP_REFLECTION | planes_of[number]);
    if (kind != WT_STEP_DIFFRACTION) continue;
    const wt_double3 next = (k + 1 < path->depth ? wt_vertex(path, k + 1) : path->to) - at;
    double shares[WT_IN_PLACES];
    wt_edge_shares(wedges + number, leg / wt_length3(leg), next / wt_length3(next), since_m, length_m - since_m,
                   wavelength_m, shares);
    wt_waves_past_edge(wedges + number, step, shares, waves);
  }
  return bends;
}

// Writes the waves with the largest weights, scaled so that their squares add up to 1. bends: as wt_waves_of returned
// it.
inline void wt_write_waves(const wt_waves* waves, wt_uint bends, WT_GLOBAL wt_path_waves* out) {
  const wt_uint count = waves->count < WT_MOST_GROUPS ? waves->count : WT_MOST_GROUPS;
  double sum = 0.0;
  for (wt_uint i = 0; i < count; ++i) sum += waves->weights[i] * waves->weights[i];
  for (wt_uint i = 0; i < count; ++i) {
    out->keys[i] = waves->keys[i];
    out->weights[i] = waves->weights[i] / sqrt(sum);
  }
  out->count = count;
  out->bends = bends;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
