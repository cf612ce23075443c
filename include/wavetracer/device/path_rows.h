// SPDX-License-Identifier: Apache-2.0
// Rows of paths: a solved path as it is, or reversed, and the functions that order rows and find equal ones.
// wt_solved in records.h describes solved paths. Vertices must lie in their surfaces to rounding error.
#ifndef WAVETRACER_DEVICE_PATH_ROWS_H
#define WAVETRACER_DEVICE_PATH_ROWS_H
#include "wavetracer/device/records.h"
#include "wavetracer/device/vector.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Two solutions are one path when ends and depth agree and every vertex does to this distance along each axis: a point
// on the border of two coplanar surfaces, or on two walls that touch, belongs to both.
#define WT_MERGE_M 1e-4

// The number of a row is twice that of a solved path, plus one where it is the path of the link the other way.
#define WT_NO_ROW 0xFFFFFFFFu

// States of a row (distinct.cl).
#define WT_ROW_STAYS 1u
#define WT_ROW_IS_NEAR 2u

#define WT_SPEED_OF_LIGHT 299792458.0  // m/s

typedef struct {
  const WT_GLOBAL wt_solved* solved;
  const WT_GLOBAL double* vertices;
  const WT_GLOBAL wt_uint* steps;
  const WT_GLOBAL double* transmitters;  // four doubles each: the position, and one that this file does not need
  const WT_GLOBAL double* receivers;
  const WT_GLOBAL wt_uint* receiver_of;     // for each transmitter the receiver in its place, or WT_NONE
  const WT_GLOBAL wt_uint* transmitter_of;  // for each receiver the transmitter in its place
  wt_uint max_depth;
} wt_path_list;

// A row, unpacked.
typedef struct {
  const WT_GLOBAL double* vertices;
  const WT_GLOBAL wt_uint* steps;
  wt_uint transmitter, receiver, depth;
  int reversed;
  wt_double3 from, to;
} wt_path;

inline wt_path wt_path_of(const wt_path_list* list, wt_uint row) {
  const wt_ulong at = row >> 1;
  const WT_GLOBAL wt_solved* solved = list->solved + at;
  wt_path out;
  out.reversed = (int)(row & 1u);
  out.vertices = list->vertices + 3 * at * list->max_depth;
  out.steps = list->steps + at * list->max_depth;
  out.depth = solved->depth;
  out.transmitter = out.reversed ? list->transmitter_of[solved->receiver] : solved->transmitter;
  out.receiver = out.reversed ? list->receiver_of[solved->transmitter] : solved->receiver;
  out.from = wt_vector(list->transmitters + 4 * (wt_ulong)out.transmitter);
  out.to = wt_vector(list->receivers + 4 * (wt_ulong)out.receiver);
  return out;
}

// The place in memory of vertex and step k, counted from the transmitter.
inline wt_uint wt_entry(const wt_path* path, wt_uint k) { return path->reversed ? path->depth - 1 - k : k; }
inline wt_double3 wt_vertex(const wt_path* path, wt_uint k) {
  return wt_vector(path->vertices + 3 * (wt_ulong)wt_entry(path, k));
}
inline wt_uint wt_step(const wt_path* path, wt_uint k) { return path->steps[wt_entry(path, k)]; }

// The kind of a step in files, see WT_STEP_CODES.
inline wt_uint wt_interaction(wt_uint step) { return (wt_uint)(WT_STEP_CODES >> 8 * (step >> WT_STEP_SHIFT)) & 0xFFu; }

inline double wt_path_length(const wt_path* path) {
  double length = 0.0;
  wt_double3 from = path->from;
  for (wt_uint k = 0; k < path->depth; ++k) {
    const wt_double3 to = wt_vertex(path, k);
    length += wt_length3(to - from);
    from = to;
  }
  return length + wt_length3(path->to - from);
}

// The length of the path from p, the stop before vertex k, to the next vertex that scatters (a tile, a cell or a point
// of a target), or to the receiver.
inline double wt_section_length(const wt_path* path, wt_uint k, wt_double3 p) {
  double length = 0.0;
  for (; k < path->depth; ++k) {
    const wt_double3 to = wt_vertex(path, k);
    const wt_uint kind = wt_step(path, k) & WT_STEP_KIND;
    length += wt_length3(to - p);
    if (kind == WT_STEP_SCATTERING || kind == WT_STEP_TARGET) return length;
    p = to;
  }
  return length + wt_length3(path->to - p);
}

inline int wt_three_way(double a, double b) { return a < b ? -1 : a > b ? 1 : 0; }
inline int wt_three_way_of_numbers(wt_uint a, wt_uint b) { return a < b ? -1 : a > b ? 1 : 0; }

// Compares paths of one depth by surfaces, then by interactions; negative where a comes first.
inline int wt_compare_steps(const wt_path* a, const wt_path* b) {
  for (wt_uint k = 0; k < a->depth; ++k) {
    const int order = wt_three_way_of_numbers(wt_step(a, k) & ~WT_STEP_KIND, wt_step(b, k) & ~WT_STEP_KIND);
    if (order != 0) return order;
  }
  for (wt_uint k = 0; k < a->depth; ++k) {
    const int order = wt_three_way_of_numbers(wt_interaction(wt_step(a, k)), wt_interaction(wt_step(b, k)));
    if (order != 0) return order;
  }
  return 0;
}

inline int wt_compare_vertices(const wt_path* a, const wt_path* b) {
  for (wt_uint k = 0; k < a->depth; ++k) {
    const wt_double3 p = wt_vertex(a, k), q = wt_vertex(b, k);
    int order = wt_three_way(p.x, q.x);
    if (order == 0) order = wt_three_way(p.y, q.y);
    if (order == 0) order = wt_three_way(p.z, q.z);
    if (order != 0) return order;
  }
  return 0;
}

// Are two paths of one link and one depth the same? Where a point of reflection comes near an edge, the diffraction
// there is another path. The path with the lowest surfaces stays, and of equal ones the one that was solved before its
// twin: *first is not 0 where that is a. Rows that differ only in their number are ordered by it. Points of targets may
// lie in one place and are never the same.
inline int wt_one_path(const wt_path* a, const wt_path* b, wt_uint row_a, wt_uint row_b, int* first) {
  int order = wt_compare_steps(a, b);
  if (order != 0)
    for (wt_uint k = 0; k < a->depth; ++k) {
      const wt_double3 d = wt_vertex(a, k) - wt_vertex(b, k);
      const wt_uint other = wt_step(a, k) ^ wt_step(b, k);
      if ((other & WT_STEP_KIND) != 0 || !(fabs(d.x) <= WT_MERGE_M) || !(fabs(d.y) <= WT_MERGE_M) ||
          !(fabs(d.z) <= WT_MERGE_M) || (other != 0 && (wt_step(a, k) & WT_STEP_KIND) == WT_STEP_TARGET))
        return 0;
    }
  if (order == 0) order = a->reversed - b->reversed;
  if (order == 0) order = wt_compare_vertices(a, b);
  if (order == 0) order = wt_three_way_of_numbers(row_a, row_b);
  *first = order < 0;
  return 1;
}

// Orders rows of one link: by delay, then surfaces, interactions and vertices; negative where a comes first.
inline int wt_compare_rows(const wt_path* a, const wt_path* b, double delay_a, double delay_b) {
  int order = wt_three_way(delay_a, delay_b);
  const wt_uint shared = a->depth < b->depth ? a->depth : b->depth;
  for (wt_uint k = 0; k < shared && order == 0; ++k)
    order = wt_three_way_of_numbers(wt_step(a, k) & ~WT_STEP_KIND, wt_step(b, k) & ~WT_STEP_KIND);
  if (order == 0) order = wt_three_way_of_numbers(a->depth, b->depth);
  if (order == 0) order = wt_compare_steps(a, b);
  return order == 0 ? wt_compare_vertices(a, b) : order;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
