// path_groups: the geometrical waves that each path of a frame is one with, and how much of it is each of them
// (wavetracer/device/path_groups.h), from rows in their order (distinct.cl). The host numbers them link by link.
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/path_groups.h"
#pragma OPENCL FP_CONTRACT OFF

// One place of the rows per work-item; what does not fit is left out, as the counter of rows tells.
// before: how many rows stand before each place.
kernel void path_groups(const global wt_solved* solved, const global double* vertices, const global uint* steps,
                        const global double* transmitter_places, const global double* receiver_places,
                        const global uint* receiver_of, const global uint* transmitter_of, const global uint* rows,
                        const global uint* before, const global wt_wedge* wedges, const global uint* planes_of,
                        global wt_path_waves* out, wt_path_groups_arguments args) {
  const uint place = get_global_id(0);
  if (place >= args.row_count || rows[place] == WT_NO_ROW || before[place] >= args.row_capacity) return;
  const wt_path_list list = {solved,          vertices,    steps,          transmitter_places,
                             receiver_places, receiver_of, transmitter_of, args.max_depth};
  const wt_path path = wt_path_of(&list, rows[place]);
  wt_waves waves;
  const uint bends = wt_waves_of(&path, wedges, planes_of, args.wavelength_m, place, &waves);
  wt_write_waves(&waves, bends, out + before[place]);
}
