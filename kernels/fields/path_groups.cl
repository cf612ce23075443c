// SPDX-License-Identifier: Apache-2.0
// path_groups: the geometrical waves that each path of a frame belongs to, and its share in each of them
// (wavetracer/device/path_groups.h), from rows in their order (distinct.cl). The host numbers them link by link.
#include "lib/prefetch_path.clh"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/path_groups.h"
#pragma OPENCL FP_CONTRACT OFF

// A work-item takes one place of the rows. Rows beyond the capacity are left out, and the counter of rows shows that.
// before: the number of rows before each place; shared: the waves of paths that belong to several, in any order, which
// has as much room as out.
kernel void path_groups(const global wt_solved* solved, const global double* vertices, const global uint* steps,
                        const global double* transmitter_places, const global double* receiver_places,
                        const global uint* receiver_of, const global uint* transmitter_of, const global uint* rows,
                        const global uint* before, const global wt_wedge* wedges, const global uint* planes_of,
                        global wt_path_wave* out, global wt_path_waves* shared, global uint* shared_count,
                        wt_path_groups_arguments args) {
  const uint place = get_global_id(0);
  if (place >= args.row_count || rows[place] == WT_NO_ROW || before[place] >= args.row_capacity) return;
  const wt_path_list list = {solved,          vertices,    steps,          transmitter_places,
                             receiver_places, receiver_of, transmitter_of, args.max_depth};
  if (WT_AHEAD > 1 && place + WT_AHEAD < args.row_count) wt_prefetch_path(&list, rows[place + WT_AHEAD]);
  const wt_path path = wt_path_of(&list, rows[place]);
  wt_waves waves;
  const uint bends = wt_waves_of(&path, wedges, planes_of, args.wavelength_m, &waves);
  wt_path_wave own = {waves.keys[0], WT_ONE_WAVE, bends, path.transmitter, path.receiver};
  if (waves.count > 1 || waves.weights[0] != 1.0) {
    own.shared = atomic_inc(shared_count);
    wt_write_waves(&waves, bends, shared + own.shared);
  }
  out[before[place]] = own;
}
