// SPDX-License-Identifier: Apache-2.0
// beam_moving: lists the apertures of a tree that is kept from which instances may be seen now, each with the part of
// its view that holds these. A work-item takes one aperture. Boxes that the static world surely hides are left out.
#include "lib/lanes.clh"
#include "lib/outlook.clh"
#include "lib/view.clh"
#pragma OPENCL FP_CONTRACT OFF

// The boxes of instances have this much room, m.
#define WT_ROOM_M 1e-6

// Widens the part of the view that is looked at to a box, of which this is the centre; deepest: its largest depth.
inline void widen_to(const wt_view* view, double3 centre, double3 half_size, wt_view_box* part, double* deepest) {
  const double least = view->height > 0.0 ? 1e-3 * view->height : 1e-9;
  for (uint k = 0; k < 8; ++k) {
    const double3 p = centre + half_size * (double3)(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
    const double depth = wt_dot3(view->n, p);
    *deepest = fmax(*deepest, depth);
    if (depth > least) {
      wt_widen_box(view, p, part);
    } else {  // the box goes through the plane of the image
      part->low_u = part->low_v = -INFINITY;
      part->high_u = part->high_v = INFINITY;
    }
  }
}

kernel void beam_moving(const global wt_exact_surface* surfaces, const global wt_aperture* apertures,
                        const global wt_outlook* outlooks, uint aperture_count, const global wt_instance_box* boxes,
                        uint box_count, global wt_aperture* out, uint capacity, global wt_beam_counters* counters,
                        uint walls) {
  const uint i = get_global_id(0);
  if (i >= aperture_count || apertures[i].passed > walls) return;
  const double3 apex = wt_vector(apertures[i].image);
  wt_view view;
  wt_view_box part;
  wt_empty_box(&part);
  double deepest = 0.0;
  uint seen = 0;
  for (uint k = 0; k < box_count; ++k) {
    const double3 low = wt_vector(boxes[k].low), high = wt_vector(boxes[k].high);
    const double3 half_size = (high - low) * 0.5 + WT_ROOM_M, centre = (low + high) * 0.5 - apex;
    if (wt_not_in_outlook(outlooks + i, convert_float3(centre), convert_float3(half_size))) continue;
    if (!seen) wt_view_through(apertures + i, surfaces, apex, &view);
    seen = 1;
    widen_to(&view, centre, half_size, &part, &deepest);
  }
  if (!seen) return;
  const uint slot = atomic_inc(&counters->apertures);
  if (slot >= capacity) return;
  out[slot] = apertures[i];
  out[slot].only_moving = 1;
  out[slot].low_u = part.low_u;
  out[slot].high_u = part.high_u;
  out[slot].low_v = part.low_v;
  out[slot].high_v = part.high_v;
  out[slot].deepest = (float)(deepest * (1.0 + 1e-6)) * (1.0f + 1e-6f);
}
