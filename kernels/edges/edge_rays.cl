// SPDX-License-Identifier: Apache-2.0
// edge_rays: launches rays from the edges that transmitters see, along the cones of their diffracted waves (Keller,
// 1962): a ray leaves the edge at the angle at which the way from the transmitter meets it. Pieces of edges that a
// building surely hides from the transmitter launch none (wedge_sight).
// Angles are as exact as the images of the prefixes, float32.
#include "lib/hit.clh"
#include "lib/trie.clh"
#include "lib/wedge.clh"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/elementary.h"
#pragma OPENCL FP_CONTRACT OFF

inline double3 axis_of(const global double* v) { return (double3)(v[0], v[1], v[2]); }

// Azimuths from `first` on, over `turn` radians.
typedef struct {
  double first, turn;
} arc;

// The azimuths whose directions do not rise: rise + slope cos(azimuth - steepest) <= 0. They are one arc.
inline arc falling(double rise, double slope, double steepest) {
  const double cosine = slope > 0.0 ? -rise / slope : 1.0;
  if (!(cosine > -1.0 && cosine < 1.0)) return (arc){0.0, 2.0 * M_PI};
  const double half_turn = wt_atan2(sqrt(1.0 - cosine * cosine), cosine);
  double first = steepest + half_turn;
  if (first < 0.0) first += 2.0 * M_PI;
  if (first >= 2.0 * M_PI) first -= 2.0 * M_PI;
  return (arc){first, 2.0 * (M_PI - half_turn)};
}

// The azimuth at this share of the part of the arc that is between the faces, from 0 to `exterior`; of all azimuths
// where nothing of the arc is.
inline double azimuth_in(arc a, double exterior, double share) {
  const double end = fmin(a.first + a.turn, exterior), part = fmax(end - a.first, 0.0);
  const double again = fmin(fmax(a.first + a.turn - 2.0 * M_PI, 0.0), fmin(exterior, a.first));
  const double at = share * (part + again);
  if (part + again < 1e-3) return share * exterior;
  return at < again ? at : a.first + (at - again);
}

// The place on an edge of `length` that is at this share of the pieces in the mask.
inline double place_in(uint pieces, uint mask, double length, double share) {
  const double at = share * popcount(mask);
  uint k = min((uint)at, popcount(mask) - 1), bits = mask;
  const double inside = at - k;
  for (; k > 0; --k) bits &= bits - 1;
  return length * ((31u - clz(bits & -bits)) + inside) / pieces;
}

// One ray per work-item: args.each of every prefix, from number args.number of prefix args.first on. keys, prefixes:
// those of wedge_prefixes that wedge_sight has left, with their pieces. The azimuths of a prefix's rays follow each
// other, so that neighbours have similar directions; places along the edge follow in steps of the golden ratio.
// Receivers are between the heights args.low and args.high, and eight of nine rays do not lead away from there.
kernel void edge_rays(const global uint* keys, const global wt_wedge_prefix* prefixes, const global wt_wedge* wedges,
                      global float* rays, wt_edge_rays_arguments args) {
  const uint k = get_global_id(0);
  if (k >= args.count) return;
  const uint i = args.first + (args.number + k) / args.each, n = (args.number + k) % args.each;
  const uint wedge = wt_wedge_of(keys[i]);
  const global wt_wedge_prefix* p = prefixes + i;
  const global wt_wedge* w = wedges + wedge;
  const double3 along = axis_of(w->along), face = axis_of(w->face), normal = axis_of(w->normal);
  const double x =
      place_in(args.pieces, p->pieces, w->length, (double)((n + 1) * 2654435769u) * 2.3283064365386963e-10);
  const double3 from = wt_on_edge(w, x);
  const double over = x - p->along, way = sqrt(over * over + (double)p->away * p->away);
  const double t = way > 0.0 ? over / way : 0.0, s = sqrt(fmax(1.0 - t * t, 0.0));
  const double share = ((double)n + 0.5) / (double)args.each;
  const double down = from.z > (double)args.high ? 1.0 : -1.0;
  double azimuth = share * w->exterior;
  if (n % 9 != 0 && (from.z > (double)args.high || from.z < (double)args.low))
    azimuth = azimuth_in(falling(down * t * along.z, s * sqrt(face.z * face.z + normal.z * normal.z),
                                 wt_atan2(down * normal.z, down * face.z)),
                         w->exterior, share);
  const wt_double2 turn = wt_cos_sin(azimuth);
  const double3 d = t * along + s * (turn.x * face + turn.y * normal);
  const double step = 1e-3 + 4e-6 * (fabs(from.x) + fabs(from.y) + fabs(from.z));
  wt_store_float3(rays, args.capacity, WT_RAY_ORIGIN, k, convert_float3(from + step * d));
  wt_store_float3(rays, args.capacity, WT_RAY_DIRECTION, k, convert_float3(d));
  wt_store_word(rays, args.capacity, WT_RAY_NODE, k, wt_with_quarter(WT_ROOT | (args.roots + wedge), n));
  wt_store_word(rays, args.capacity, WT_RAY_SURFACE, k, w->surfaces[2.0 * azimuth > w->exterior ? 1 : 0]);
}
