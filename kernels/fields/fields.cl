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

// A work-item takes one place of the rows, or of the list. Rows beyond the capacity are left out, and the counters of
// rows and vertices show that. before: for each place the number of rows before it, then the number of all rows and of
// vertices. listed: the length of the list, then the places of the rows that go past corners; null where all rows are
// taken at once.
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
#if WT_LISTED
  if (get_global_id(0) >= listed[0]) return;
  const uint place = listed[1 + get_global_id(0)];
#else
  const uint place = get_global_id(0);
#endif
  if (place >= args.row_count || rows[place] == WT_NO_ROW) return;
  const uint first_row = before[place], first_vertex = before[args.row_count + place] - before[args.row_count];
  if (first_row >= args.row_capacity || first_vertex + WT_MAX_DEPTH > args.vertex_capacity) return;
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
#if WT_DIFFRACTS && !WT_CORNER_EDGES
  const wt_path path = wt_path_of(&list, rows[place]);
  if (listed && wt_passes_corner(&world, &path)) {
    listed[1 + atomic_inc(listed)] = place;
    return;
  }
#endif
  const wt_ordered_rows ordered = {&list, rows, delays, args.row_count};
  wt_write_row(&world, &ordered, place, quarters[place], (double3)(args.origin[0], args.origin[1], args.origin[2]),
               first_vertex, out + first_row, out_vertices);
}
