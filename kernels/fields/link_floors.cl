// SPDX-License-Identifier: Apache-2.0
// link_floors: the power below which a link needs no path over edges (trace.diffraction_range_db), from its strongest
// path without edges; wedge_solve leaves weaker ones out and adds up what they have at most. most_left_out finds the
// link that lacks most.
#include "lib/count.clh"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/path_field.h"
#pragma OPENCL FP_CONTRACT OFF

// Links of a work-item of most_left_out.
#define WT_LINKS_OF_ITEM 64u

// The floor that a path without edges gives its link. most_powers: the largest gain of each antenna, over all ports.
inline float floor_of(const wt_field_world* world, const wt_path* path, uint solved, const global double* most_powers,
                      double scale) {
  const wt_path_field field = wt_field_of_path(world, 0, 0, path, solved);
  double power = 0.0;
  for (int i = 0; i < 4; ++i) power += wt_norm(field.a[i]);
  return (float)(scale * power /
                 (most_powers[world->transmitters[path->transmitter].antenna] *
                  most_powers[world->receivers[path->receiver].antenna]));
}

// A work-item takes a visible path; none of them has an edge. The path serves the link the other way, too, if there is
// one: the lower floor of both counts. floors: bits of positive numbers, which are in the order of the numbers, by
// transmitter and receiver; all are 0 before.
kernel void link_floors(const global wt_solved* solved, const global double* vertices, const global uint* steps,
                        const global double* transmitter_places, const global double* receiver_places,
                        const global uint* receiver_of, const global uint* transmitter_of,
                        const global wt_exact_surface* surfaces, const global uint* materials_of,
                        const global wt_material* materials, const global wt_exact_instance* instances,
                        const global wt_field_end* transmitters, const global wt_field_end* receivers,
                        const global wt_antenna* antennas, const global double* samples,
                        const global double* most_powers, const global wt_foliage* foliages,
                        const global double* lengths_inside, volatile global uint* floors,
                        const global wt_counters* counters, wt_link_floors_arguments args) {
  const uint i = get_global_id(0);
  if (i >= wt_length(counters, args.visible_counter, args.visible_count)) return;
  const wt_path_list list = {solved,          vertices,    steps,          transmitter_places,
                             receiver_places, receiver_of, transmitter_of, args.max_depth};
  const wt_field_world world = {surfaces,
                                materials_of,
                                materials,
                                0,
                                0,
                                0,
                                instances,
                                transmitters,
                                receivers,
                                antennas,
                                samples,
                                args.wavelength_m,
                                0,
                                args.transmissions,
                                args.reflections,
                                args.scatters,
                                args.foliage_count,
                                foliages,
                                lengths_inside,
                                args.air,
                                0,
                                0,
                                0,
                                0};
  const wt_path path = wt_path_of(&list, 2 * i);
  if (wt_is_near(&world, &path)) return;  // distinct leaves it out
  float least = floor_of(&world, &path, i, most_powers, args.scale);
  if (receiver_of[path.transmitter] != WT_NONE && transmitter_of[path.receiver] != WT_NONE) {
    const wt_path back = wt_path_of(&list, 2 * i + 1);
    least = fmin(least, floor_of(&world, &back, i, most_powers, args.scale));
  }
  if (least > 0.0f) atomic_max(floors + (size_t)path.transmitter * args.receiver_count + path.receiver, as_uint(least));
}

kernel void most_left_out(const global uint* left_out, uint count, volatile global uint* most) {
  const uint begin = WT_LINKS_OF_ITEM * get_global_id(0);
  uint here = 0;
  for (uint i = begin; i < min(begin + WT_LINKS_OF_ITEM, count); ++i) here = max(here, left_out[i]);
  if (here > 0) atomic_max(most, here);
}
