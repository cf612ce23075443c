// SPDX-License-Identifier: Apache-2.0
// Volumes of vegetation, which waves pass, and the length of a straight leg inside of one.
// All is in double, with the same bits on every device. A mesh is closed and its triangles are counter-clockwise seen
// from outside.
#ifndef WAVETRACER_DEVICE_VOLUMES_H
#define WAVETRACER_DEVICE_VOLUMES_H
#include "wavetracer/device/field_records.h"
#include "wavetracer/device/vector.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// A part of a leg; its ends are shares of the leg.
typedef struct {
  double first, last;
} wt_share;

// The part of the share where p + t q is between -1 and 1.
inline wt_share wt_between_planes(wt_share share, double p, double q) {
  if (q == 0.0) {
    if (fabs(p) > 1.0) share.last = share.first;
    return share;
  }
  const double a = (-1.0 - p) / q, b = (1.0 - p) / q;
  share.first = fmax(share.first, fmin(a, b));
  share.last = fmin(share.last, fmax(a, b));
  return share;
}

// The part of the share where p + t q is in the unit ball. It is computed from the point nearest to the middle: far
// away nothing cancels.
inline wt_share wt_in_ball(wt_share share, wt_double3 p, wt_double3 q) {
  const double a = wt_dot3(q, q), middle = a > 0.0 ? -wt_dot3(p, q) / a : 0.0;
  const wt_double3 nearest = p + q * middle;
  const double left = 1.0 - wt_dot3(nearest, nearest);
  if (!(left > 0.0)) {
    share.last = share.first;
    return share;
  }
  if (!(a > 0.0)) return share;
  const double reach = sqrt(left / a);
  share.first = fmax(share.first, middle - reach);
  share.last = fmin(share.last, middle + reach);
  return share;
}

inline double wt_axis(wt_double3 v, wt_uint axis) { return axis == 0u ? v.x : axis == 1u ? v.y : v.z; }

// On which side of the edge from a to b, seen along the leg, is the leg? A leg that meets the edge is treated as if it
// were a little to the side. The triangle beyond the edge sees it on the same side, so exactly one of the two is met.
inline int wt_left_of(wt_double2 a, wt_double2 b, double area) {
  if (area != 0.0) return area > 0.0;
  if (a.y != b.y) return a.y > b.y;
  return a.x < b.x;
}

// The place where the line of a leg passes a triangle of a closed mesh, in metres from its beginning, and in which
// direction.
typedef struct {
  double at_m;
  int side;  // 1: it leaves the mesh there, -1: it enters, 0: it passes the triangle by
} wt_crossing;

inline wt_crossing wt_crossing_at(const WT_GLOBAL double* triangle, wt_double3 from, wt_double3 along, wt_uint axis) {
  const wt_uint right = (axis + 1u) % 3u, up = (axis + 2u) % 3u;
  const double depth = wt_axis(along, axis);
  const double shear_x = wt_axis(along, right) / depth, shear_y = wt_axis(along, up) / depth;
  wt_double2 p[3];
  double z[3];
  for (int i = 0; i < 3; ++i) {
    const wt_double3 corner = wt_vector(triangle + 3 * i) - from;
    z[i] = wt_axis(corner, axis);
    p[i] = WT_DOUBLE2(wt_axis(corner, right) - shear_x * z[i], wt_axis(corner, up) - shear_y * z[i]);
  }
  double area[3];
  int left = 0;
  for (int i = 0; i < 3; ++i) {
    const wt_double2 a = p[(i + 1) % 3], b = p[(i + 2) % 3];
    area[i] = a.x * b.y - a.y * b.x;
    left += wt_left_of(a, b, area[i]);
  }
  wt_crossing out = {0.0, 0};
  const double whole = area[0] + area[1] + area[2];
  if ((left != 0 && left != 3) || whole == 0.0) return out;
  out.at_m = (area[0] * z[0] + area[1] * z[1] + area[2] * z[2]) / (whole * depth);
  out.side = (left == 3) == (depth > 0.0) ? 1 : -1;
  return out;
}

// Returns by how much the leg leaves (or, negative, enters) a closed mesh at this triangle before its own end. The sum
// over all triangles is the length inside: a passage after the end of the leg counts 0, one before its beginning the
// whole leg.
inline double wt_leaves_at(const WT_GLOBAL double* triangle, wt_double3 from, wt_double3 along, double length_m,
                           wt_uint axis) {
  const wt_crossing c = wt_crossing_at(triangle, from, along, axis);
  if (c.side == 0) return 0.0;
  const double reached = fmin(fmax(c.at_m, 0.0), length_m);
  return c.side > 0 ? reached : -reached;
}

// The axis that a line is closest to.
inline wt_uint wt_main_axis(wt_double3 along) {
  const double x = fabs(along.x), y = fabs(along.y), z = fabs(along.z);
  return x > y && x > z ? 0u : y > z ? 1u : 2u;
}

inline double wt_length_in_mesh(const WT_GLOBAL double* triangles, wt_uint count, wt_double3 from, wt_double3 along,
                                double length_m) {
  const wt_uint axis = wt_main_axis(along);
  double inside = 0.0;
  for (wt_uint i = 0; i < count; ++i) inside += wt_leaves_at(triangles + 9 * (wt_ulong)i, from, along, length_m, axis);
  return fmin(fmax(inside, 0.0), length_m);
}

// Lengths are summed in whole units of 2^-40 m, so no sum depends on the order of its terms.
inline wt_ulong wt_parts_of_length(double length_m) { return (wt_ulong)(length_m * 1099511627776.0 + 0.5); }
inline double wt_length_of_parts(wt_ulong parts) { return (double)parts / 1099511627776.0; }

// The share of a leg that is inside of a volume; for a mesh, inside of its box. It is empty where it does not end after
// its beginning.
inline wt_share wt_share_inside(const WT_GLOBAL wt_volume* volume, wt_double3 from, wt_double3 leg) {
  const wt_double3 size = wt_vector(volume->half_size), away = from - wt_vector(volume->centre);
  const double c = volume->cosine, s = volume->sine;
  const wt_double3 p =
      WT_DOUBLE3((c * away.x + s * away.y) / size.x, (c * away.y - s * away.x) / size.y, away.z / size.z);
  const wt_double3 q = WT_DOUBLE3((c * leg.x + s * leg.y) / size.x, (c * leg.y - s * leg.x) / size.y, leg.z / size.z);
  wt_share share = {0.0, 1.0};
  if (volume->shape == WT_VOLUME_SPHEROID) {
    share = wt_in_ball(share, p, q);
  } else {
    share = wt_between_planes(share, p.z, q.z);
    if (volume->shape == WT_VOLUME_CYLINDER) {
      share = wt_in_ball(share, WT_DOUBLE3(p.x, p.y, 0.0), WT_DOUBLE3(q.x, q.y, 0.0));
    } else {
      share = wt_between_planes(share, p.x, q.x);
      share = wt_between_planes(share, p.y, q.y);
    }
  }
  return share;
}

// Returns how much of the leg is inside of the volume, in metres. triangles: nine doubles each, those of all meshes.
inline double wt_length_inside(const WT_GLOBAL wt_volume* volume, const WT_GLOBAL double* triangles, wt_double3 from,
                               wt_double3 to) {
  const wt_double3 leg = to - from;
  const double length_m = wt_length3(leg);
  if (!(length_m > 0.0)) return 0.0;
  if (volume->shape == WT_VOLUME_MESH)
    return wt_length_in_mesh(triangles + 9 * (wt_ulong)volume->first_triangle, volume->triangle_count, from,
                             leg / length_m, length_m);
  const wt_share share = wt_share_inside(volume, from, leg);
  return share.last > share.first ? (share.last - share.first) * length_m : 0.0;
}

// A leg, for questions about the places on it where volumes are.
typedef struct {
  wt_double3 from, leg, along;
  double length_m;
  wt_uint axis;
} wt_leg;

inline wt_leg wt_leg_between(wt_double3 from, wt_double3 to) {
  wt_leg out;
  out.from = from;
  out.leg = to - from;
  out.length_m = wt_length3(out.leg);
  out.along = out.leg / out.length_m;
  out.axis = wt_main_axis(out.along);
  return out;
}

// The part of the leg, in metres, from its first point in the volume to its last one, hollows included.
inline wt_share wt_reach_of(const WT_GLOBAL wt_volume* volume, const WT_GLOBAL double* triangles, wt_leg leg) {
  wt_share out = wt_share_inside(volume, leg.from, leg.leg);
  out.first *= leg.length_m;
  out.last *= leg.length_m;
  if (volume->shape != WT_VOLUME_MESH || !(out.last > out.first)) return out;
  const WT_GLOBAL double* own = triangles + 9 * (wt_ulong)volume->first_triangle;
  out.first = leg.length_m;
  out.last = 0.0;
  for (wt_uint i = 0; i < volume->triangle_count; ++i) {
    const wt_crossing c = wt_crossing_at(own + 9 * (wt_ulong)i, leg.from, leg.along, leg.axis);
    if (c.side < 0) out.first = fmin(out.first, fmax(c.at_m, 0.0));
    if (c.side > 0) out.last = fmax(out.last, fmin(c.at_m, leg.length_m));
  }
  return out;
}

// The next place after after_m where the leg enters or leaves the volume; last_m where there is none before it.
inline double wt_next_border(const WT_GLOBAL wt_volume* volume, const WT_GLOBAL double* triangles, wt_leg leg,
                             double after_m, double last_m) {
  double out = last_m;
  if (volume->shape != WT_VOLUME_MESH) {
    const wt_share share = wt_share_inside(volume, leg.from, leg.leg);
    const double first = share.first * leg.length_m, last = share.last * leg.length_m;
    if (!(last > first)) return out;
    if (last > after_m) out = fmin(out, last);
    return first > after_m ? fmin(out, first) : out;
  }
  const WT_GLOBAL double* own = triangles + 9 * (wt_ulong)volume->first_triangle;
  for (wt_uint i = 0; i < volume->triangle_count; ++i) {
    const wt_crossing c = wt_crossing_at(own + 9 * (wt_ulong)i, leg.from, leg.along, leg.axis);
    if (c.side != 0 && c.at_m > after_m) out = fmin(out, c.at_m);
  }
  return out;
}

// Is the leg inside of the volume at_m metres from its beginning? That place is no border.
inline int wt_is_inside(const WT_GLOBAL wt_volume* volume, const WT_GLOBAL double* triangles, wt_leg leg, double at_m) {
  if (volume->shape != WT_VOLUME_MESH) {
    const wt_share share = wt_share_inside(volume, leg.from, leg.leg);
    return at_m > share.first * leg.length_m && at_m < share.last * leg.length_m;
  }
  const WT_GLOBAL double* own = triangles + 9 * (wt_ulong)volume->first_triangle;
  int left = 0;  // number of times the line leaves after at_m, less how often it enters
  for (wt_uint i = 0; i < volume->triangle_count; ++i) {
    const wt_crossing c = wt_crossing_at(own + 9 * (wt_ulong)i, leg.from, leg.along, leg.axis);
    if (c.at_m > at_m) left += c.side;
  }
  return left > 0;
}

// The volumes of a scene. Space inside of several of them belongs to the first one. earlier[k] to earlier[k + 1] - 1
// are the places, in this same list, of the numbers of the volumes before k whose boxes meet its own.
typedef struct {
  const WT_GLOBAL wt_volume* volumes;
  const WT_GLOBAL double* triangles;
  const WT_GLOBAL wt_uint* earlier;
} wt_volumes;

inline const WT_GLOBAL wt_volume* wt_earlier(wt_volumes all, wt_uint i) { return all.volumes + all.earlier[i]; }

// Does the leg go through an earlier volume between two places?
inline int wt_meets_earlier(wt_volumes all, wt_uint volume, wt_leg leg, wt_share own) {
  for (wt_uint i = all.earlier[volume]; i < all.earlier[volume + 1u]; ++i) {
    const wt_share reach = wt_reach_of(wt_earlier(all, i), all.triangles, leg);
    if (reach.last > own.first && reach.first < own.last && reach.last > reach.first) return 1;
  }
  return 0;
}

// Returns how much of the leg is in the space of this volume, in metres: inside of it, and of none before it.
inline double wt_length_in_space(wt_volumes all, wt_uint volume, wt_double3 from, wt_double3 to) {
  const WT_GLOBAL wt_volume* own = all.volumes + volume;
  const double whole_m = wt_length_inside(own, all.triangles, from, to);
  const wt_uint first = all.earlier[volume], end = all.earlier[volume + 1u];
  if (first == end || !(whole_m > 0.0)) return whole_m;
  const wt_leg leg = wt_leg_between(from, to);
  const wt_share reach = wt_reach_of(own, all.triangles, leg);
  if (!wt_meets_earlier(all, volume, leg, reach)) return whole_m;
  double sum_m = 0.0;
  for (double at_m = reach.first; at_m < reach.last;) {
    double next_m = wt_next_border(own, all.triangles, leg, at_m, reach.last);
    for (wt_uint i = first; i < end; ++i) next_m = wt_next_border(wt_earlier(all, i), all.triangles, leg, at_m, next_m);
    const double middle_m = 0.5 * (at_m + next_m);
    int mine = wt_is_inside(own, all.triangles, leg, middle_m);
    for (wt_uint i = first; i < end && mine; ++i)
      mine = !wt_is_inside(wt_earlier(all, i), all.triangles, leg, middle_m);
    if (mine) sum_m += next_m - at_m;
    at_m = next_m;
  }
  return fmin(sum_m, whole_m);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
