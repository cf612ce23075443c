// SPDX-License-Identifier: Apache-2.0
// visible: copies the solved paths without an obstructed leg side by side, so that the host reads no others. They are
// in no particular order; counters->visible is their number.
#include "lib/count.clh"

// A work-item takes one solved path; rows of both lists have max_depth vertices and surfaces.
kernel void visible(const global wt_solved* solved, const global double* vertices, const global uint* sequences,
                    uint solved_count, uint solved_counter, uint max_depth, global wt_solved* out,
                    global double* out_vertices, global uint* out_sequences, uint capacity,
                    global wt_counters* counters) {
  const uint i = get_global_id(0);
  if (i >= wt_length(counters, solved_counter, solved_count) || solved[i].blocked) return;
  const uint slot = atomic_inc(&counters->visible);
  if (slot >= capacity) return;
  out[slot] = solved[i];
  const size_t from = (size_t)i * max_depth, to = (size_t)slot * max_depth;
  for (uint k = 0; k < solved[i].depth; ++k) {
    out_sequences[to + k] = sequences[from + k];
    for (uint axis = 0; axis < 3; ++axis) out_vertices[3 * (to + k) + axis] = vertices[3 * (from + k) + axis];
  }
}
