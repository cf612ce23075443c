// SPDX-License-Identifier: Apache-2.0
// fields: the columns of the paths of a frame, from rows in their order (distinct.cl): delay, angles, coefficients and
// Doppler shift of each (wavetracer/device/path_field.h), and its vertices.
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/field_row.h"
#pragma OPENCL FP_CONTRACT OFF

// On GPUs paths past corners, whose fields take much longer, would hold up their neighbours. So they are listed by a
// build that leaves them out (WT_CORNER_EDGES is 0), and a second one takes the list (WT_LISTED is 1).
#ifndef WT_LISTED
#define WT_LISTED 0
#endif

// On CPUs a work-item takes a run of up to so many rows, and computes those of one shape eight at once.
#ifndef WT_TOGETHER
#define WT_TOGETHER 1u
#endif

// The places where rows are read from, and go to. before, for_sums: see the kernel and its arguments.
typedef struct {
  const global uchar* quarters;
  const global uint* before;
  double3 origin;
  global wt_path_row* rows;
  global wt_vertex_row* vertices;
  uint row_count, row_capacity, vertex_capacity, for_sums;
} wt_row_places;

inline uint wt_first_vertex(const wt_row_places* to, uint place) {
  return to->before[to->row_count + place] - to->before[to->row_count];
}

// Is there a row at this place, and room for it?
inline int wt_has_place(const wt_ordered_rows* ordered, const wt_row_places* to, uint place) {
  return place < to->row_count && ordered->rows[place] != WT_NO_ROW && to->before[place] < to->row_capacity &&
         (to->for_sums || wt_first_vertex(to, place) + WT_MAX_DEPTH <= to->vertex_capacity);
}

#if WT_TOGETHER > 1
#include "lib/field_rows8.clh"
#else
// Writes the row of a work-item. listed: see the kernel.
inline void write_place(const wt_field_world* world, const wt_ordered_rows* ordered, const wt_row_places* to, uint item,
                        global uint* listed) {
#if WT_LISTED
  if (item >= listed[0]) return;
  const uint place = listed[1 + item];
#else
  const uint place = item;
#endif
  if (!wt_has_place(ordered, to, place)) return;
#if WT_DIFFRACTS && !WT_CORNER_EDGES
  const wt_path path = wt_path_of(ordered->list, ordered->rows[place]);
  if (listed && wt_passes_corner(world, &path)) {
    listed[1 + atomic_inc(listed)] = place;
    return;
  }
#endif
  wt_write_row(world, ordered, place, to->quarters[place], to->origin, wt_first_vertex(to, place),
               to->rows + to->before[place], to->for_sums ? 0 : to->vertices);
}
#endif

// A work-item takes one place of the rows, or of the list, or a run of places. Rows beyond the capacity are left out,
// and the counters of rows and vertices show that. before: for each place the number of rows before it, then the number
// of all rows and of vertices. listed: the length of the list, then the places of the rows that go past corners; null
// where all rows are taken at once.
kernel void fields(const global wt_solved* solved, const global double* vertices, const global uint* steps,
                   const global double* transmitter_places, const global double* receiver_places,
                   const global uint* receiver_of, const global uint* transmitter_of, const global uint* rows,
                   const global double* delays, const global uchar* quarters, const global uint* before,
                   const global wt_exact_surface* surfaces, const global uint* materials_of,
                   const global wt_material* materials, const global wt_wedge* wedges,
                   const global uint* surface_of_tile, const global double* area_of_tile,
                   const global wt_exact_instance* instances, const global wt_field_end* transmitters,
                   const global wt_field_end* receivers, const global wt_antenna* antennas,
                   const global double* samples, const global wt_foliage* foliages, const global double* lengths_inside,
                   const global wt_target_point* targets, const global wt_target_law* laws,
                   const global wt_target_lobe* lobes, const global wt_target_facet* facets, global uint* listed,
                   global wt_path_row* out, global wt_vertex_row* out_vertices, wt_fields_arguments args) {
  const wt_path_list list = {solved,          vertices,    steps,          transmitter_places,
                             receiver_places, receiver_of, transmitter_of, args.max_depth};
  const wt_field_world world = {surfaces,
                                materials_of,
                                materials,
                                wedges,
                                surface_of_tile,
                                area_of_tile,
                                instances,
                                transmitters,
                                receivers,
                                antennas,
                                samples,
                                args.wavelength_m,
                                args.seed,
                                args.transmissions,
                                args.reflections,
                                args.scatters,
                                args.foliage_count,
                                foliages,
                                lengths_inside,
                                args.air,
                                targets,
                                laws,
                                lobes,
                                facets};
  const wt_ordered_rows ordered = {&list, rows, delays, args.row_count};
  const double3 origin = (double3)(args.origin[0], args.origin[1], args.origin[2]);
  const wt_row_places to = {
      quarters,     before, origin, out, out_vertices, args.row_count, args.row_capacity, args.vertex_capacity,
      args.for_sums};
  const uint item = get_global_id(0);
#if WT_TOGETHER > 1
  const uint begin = args.rows_of_item * item, end = min(begin + args.rows_of_item, args.row_count);
  if (begin < end) wt_write_rows8(&world, &ordered, &to, begin, end);
#else
  write_place(&world, &ordered, &to, item, listed);
#endif
}
