// SPDX-License-Identifier: Apache-2.0
// beam_unite: puts together apertures of one sequence that make up a convex part of their mirror, so that fewer are
// followed. beam_link makes a list of the apertures of each sequence; a group of WT_LANES work-items takes such a list,
// in an order that depends on its apertures alone.
#include "lib/hull.clh"
#include "wavetracer/device/bvh.h"
#pragma OPENCL FP_CONTRACT OFF

// Lists of more apertures stay as they are: on GPUs all wait for the group that has the longest list.
#define WT_UNITED 16u

// A list of apertures of one sequence.
typedef struct {
  uint index[WT_UNITED];     // their places among all apertures
  wt_patch part[WT_UNITED];  // in their own order
  uint count, found, slot;
} wt_list;

// Is aperture a before b? Those of one sequence differ in their corners; where they do not, all else is compared.
inline int is_before(const global wt_aperture* a, const global wt_aperture* b) {
  if (a->passed != b->passed) return a->passed < b->passed;
  if (a->count != b->count) return a->count < b->count;
  for (uint k = 0; k < 3 * a->count; ++k)
    if (a->corners[k] != b->corners[k]) return a->corners[k] < b->corners[k];
  return a->kept < b->kept;
}

// Lists the apertures of the sequence whose last one is `last`. One work-item does it. A list that is too long has a
// count of more than WT_UNITED.
inline void collect(uint last, const global uint* before, local wt_list* list) {
  uint count = 0;
  for (uint i = last; i != WT_NONE && count <= WT_UNITED; i = before[i]) {
    if (count < WT_UNITED) list->index[count] = i;
    ++count;
  }
  list->count = count;
}

// Puts the apertures of a list into their order, as parts of the plane of their mirror.
inline void order(const global wt_aperture* apertures, const global wt_exact_surface* surfaces, local wt_list* list) {
  const uint lane = wt_lane(), count = list->count;
  const global wt_aperture* any = apertures + list->index[0];
  const double3 apex = wt_vector(any->image), n = wt_vector(surfaces[any->surface].normal);
  double3 u, v;
  wt_axes_across(n, &u, &v);
  for (uint k = lane; k < count; k += WT_LANES) {
    uint rank = 0;
    for (uint j = 0; j < count; ++j)
      rank += j < k ? !is_before(apertures + list->index[k], apertures + list->index[j])
                    : j > k && is_before(apertures + list->index[j], apertures + list->index[k]);
    const global wt_aperture* a = apertures + list->index[k];
    local wt_patch* part = list->part + rank;
    for (uint i = 0; i < a->count; ++i) {
      const double3 p = wt_vector(a->corners + 3 * i) - apex;
      part->u[i] = wt_dot3(u, p);
      part->v[i] = wt_dot3(v, p);
      part->from[i] = list->index[k] * WT_CORNERS + i;
    }
    part->count = a->count;
    part->passed = a->passed;
    part->kept = a->kept;
    wt_measure(part);
  }
  WT_SYNC();
}

// Unites the parts of a list as long as two of them can be. A part that another one took has no corners.
inline void unite(local wt_list* list) {
  const uint lane = wt_lane(), count = list->count;
  for (uint a = 0; a < count; ++a) {
    for (;;) {
      if (lane == 0) list->found = count;
      WT_SYNC();
      uint mine = count;
      for (uint j = lane; j < count && mine == count; j += WT_LANES)
        if (j != a && wt_unites(list->part + a, list->part + j)) mine = j;
      if (mine < count) wt_least(&list->found, mine);
      WT_SYNC();
      const uint found = list->found;
      WT_SYNC();
      if (found == count) break;
      if (lane == 0) wt_unite(list->part + a, list->part + found);
      WT_SYNC();
    }
  }
}

// Appends the first aperture of a part to `out`, with the corners of the part.
inline void store(const global wt_aperture* apertures, const local wt_patch* part, global wt_aperture* out) {
  const uint lane = wt_lane(), first = part->from[0] / WT_CORNERS;
  if (lane == 0) {
    *out = apertures[first];
    out->count = part->count;
    out->kept = part->kept;
  }
  WT_SYNC();
  for (uint k = lane; k < part->count; k += WT_LANES) {
    const uint from = part->from[k];
    vstore3(wt_vector(apertures[from / WT_CORNERS].corners + 3 * (from % WT_CORNERS)), k, out->corners);
  }
}

kernel void beam_link(const global wt_aperture* apertures, uint count, global uint* last, global uint* before) {
  const uint i = get_global_id(0);
  if (i < count) before[i] = atomic_xchg(last + apertures[i].node, i);
}

// last: for each slot of the trie, WT_NONE again once the list was taken.
kernel void beam_unite(const global wt_aperture* apertures, const global wt_exact_surface* surfaces,
                       volatile global uint* last, const global uint* before, global wt_aperture* out,
                       global wt_beam_counters* counters) {
  local wt_list list;
  const uint i = get_group_id(0), lane = wt_lane(), node = apertures[i].node;
  if (lane == 0) {
    list.count = 0;
    if (atomic_cmpxchg(last + node, i, WT_NONE) == i) collect(i, before, &list);
  }
  WT_SYNC();
  if (list.count == 0) return;  // another group has the list
  const int whole = list.count > WT_UNITED;
  if (!whole) {
    order(apertures, surfaces, &list);
    unite(&list);
  }
  uint at = i;
  for (uint k = 0; whole ? at != WT_NONE : k < list.count; ++k) {
    if (!whole && list.part[k].count == 0) continue;
    if (lane == 0) list.slot = atomic_inc(&counters->apertures);
    WT_SYNC();
    if (!whole) store(apertures, list.part + k, out + list.slot);
    if (whole && lane == 0) out[list.slot] = apertures[at];
    if (whole) at = before[at];
    WT_SYNC();
  }
}
