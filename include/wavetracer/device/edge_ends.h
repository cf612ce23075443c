// SPDX-License-Identifier: Apache-2.0
// The wave that an edge with ends diffracts. An edge is a line of sources. A term of its wave whose
// argument at a boundary is s (transition.h) is the integral over the edge of s / (x^2 + s^2) exp(-j x^2), where x^2 is
// the phase by which the way over a place of the edge is longer than the shortest way, and the fraction is the pole of
// the sources at the boundary. So beyond an end is the same integral from there on, the generalized Fresnel integral
// (P. Clemmow and T. Senior, Proc. Camb. Phil. Soc. 49, 1953; F. Capolino and S. Maci, Microw. Opt. Technol. Lett.
// 9(1), 1995). No end needs to know the edges that meet it: the waves of all edges of a plate add up to Kirchhoff's
// integral, a corner's wave included. Where the shortest way leaves the edge, the path goes over its end.
#ifndef WAVETRACER_DEVICE_EDGE_ENDS_H
#define WAVETRACER_DEVICE_EDGE_ENDS_H
#include "wavetracer/device/double_transition.h"
#include "wavetracer/device/elementary.h"
#include "wavetracer/device/records.h"
#include "wavetracer/device/vector.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The waves of both ends of an edge, with the phase of the path's own length.
typedef struct {
  int counts;            // 0: the edge is as one without ends, and the rest is not set
  wt_double2 whole;      // the factor of the wave of the edge without ends: 0 where the shortest way leaves the edge
  double place[2];       // x of either end, 0 or more
  wt_double2 beyond[2];  // the factor of the part beyond it: 0 far from the shortest way
} wt_edge_ends;

inline wt_edge_ends wt_without_ends(void) {
  wt_edge_ends ends;
  ends.counts = 0;
  return ends;
}

// From this argument on the pole is so far away that two terms of its series in t^2 - x^2 give the part beyond x, to
// 5e-5 of the wave that ends at the boundary.
#define WT_FAR_POLE 6.0

// The integral from x on of s / (t^2 + s^2) exp(-j (t^2 - x^2)), for s beyond WT_FAR_POLE. Those of 1 and t^2 in place
// of the fraction are known.
inline wt_double2 wt_beyond_by_series(double s, double x) {
  const wt_double2 g = wt_transition_over_root(x), of_one = WT_DOUBLE2(0.5 * g.y, -0.5 * g.x);
  const wt_double2 of_square = WT_DOUBLE2(0.5 * of_one.y, -0.5 * (x + of_one.x));
  const double pole = 1.0 / (x * x + s * s);
  return (of_one - (of_square - of_one * (x * x)) * pole) * (s * pole);
}

// The part of g(s) that sources from x on have, without the phase exp(-j x^2) of the way over that place; x >= 0. At 0
// it is half of g(s). In Owen's form it is the integral of the slope's function over directions.
inline wt_double2 wt_transition_beyond(double s, double x) {
  const double from = fmax(x, WT_LEAST_ARGUMENT);
  const wt_double2 sum = s > WT_FAR_POLE ? wt_beyond_by_series(s, x) : wt_sum_of_slopes(from, s, s / from);
  return wt_times(WT_EIGHTH_TURN, sum) * WT_INV_SQRT_PI;
}

// The part of g(s), whose value is g, that the edge between its ends has.
inline wt_double2 wt_transition_between(double s, wt_double2 g, const wt_edge_ends* ends) {
  wt_double2 sum = wt_times(g, ends->whole);
  for (int i = 0; i < 2; ++i)
    if (ends->beyond[i].x != 0.0 || ends->beyond[i].y != 0.0)
      sum = sum + wt_times(wt_transition_beyond(s, ends->place[i]), ends->beyond[i]);
  return sum;
}

// A way over the line of an edge: where its ends are along the line, and how far from it.
typedef struct {
  double from, to;      // metres along the edge from its start
  double from_m, to_m;  // distances from the line
} wt_way_over;

inline double wt_length_at(const wt_way_over* way, double x) {
  const double a = x - way->from, b = way->to - x;
  return sqrt(a * a + way->from_m * way->from_m) + sqrt(b * b + way->to_m * way->to_m);
}

inline double wt_shortest_at(const wt_way_over* way) {
  return (way->from * way->to_m + way->to * way->from_m) / (way->from_m + way->to_m);
}

inline int wt_ends_freely(const WT_GLOBAL wt_wedge* wedge, int end) {
  return (wedge->free_ends & (end == 0 ? WT_FREE_START : WT_FREE_END)) != 0;
}

// Paths over an end are put this far inside of it, so that those of two edges that meet there are two.
inline double wt_place_of_end(const WT_GLOBAL wt_wedge* wedge, int end) {
  return end == 0 ? WT_END_INSET_M : wedge->length - WT_END_INSET_M;
}

// 1 where an end is on the shortest way, 0 from a detour of WT_END_DETOUR wavelengths on, and smooth in between.
inline double wt_end_share(double detour) {
  const double part = fmin(detour / WT_END_DETOUR, 1.0), square = part * part;
  return (1.0 - square * square) * (1.0 - square * square);
}

// A path of the length path_m over an edge of free ends. over_end: the path was put at a place of an end.
inline wt_edge_ends wt_ends_on(const WT_GLOBAL wt_wedge* wedge, const wt_way_over* way, double path_m, int over_end,
                               double wavelength_m) {
  wt_edge_ends ends;
  const double shortest = wt_shortest_at(way), shortest_m = wt_length_at(way, shortest), k = 2.0 * WT_PI / wavelength_m;
  ends.counts = over_end;
  ends.whole = over_end ? wt_cos_sin(k * (path_m - shortest_m)) : wt_real(1.0);
  for (int i = 0; i < 2; ++i) {
    ends.place[i] = 0.0;
    ends.beyond[i] = wt_real(0.0);
    if (!wt_ends_freely(wedge, i)) continue;
    const double end = i == 0 ? 0.0 : wedge->length, end_m = wt_length_at(way, end);
    const double detour_m = fmax(end_m - shortest_m, 0.0), share = wt_end_share(detour_m / wavelength_m);
    const int inside = i == 0 ? shortest >= end : shortest <= end;
    if (!inside) ends.whole = wt_real(0.0);
    if (share == 0.0) continue;
    ends.counts = 1;
    ends.place[i] = sqrt(k * detour_m);
    ends.beyond[i] = wt_cos_sin(k * (path_m - end_m)) * (inside ? -share : share);
  }
  return ends;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
