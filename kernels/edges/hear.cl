// SPDX-License-Identifier: Apache-2.0
// hear: follows rays that come from edges to the listeners that they pass. A listener is all receivers in a square of
// the ground plan; a ray passes it where its segment crosses the square not far above or below these. The surfaces that
// the ray has met are entered into the trie of the listeners, the last one first, and behind them the edge that the ray
// came from.
#include "lib/hit.clh"
#include "lib/images.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

typedef struct {
  float3 from, along;
  float begin, end;
} wt_part;

// Shortens the part to low <= at + t along <= high; 0 where nothing is left.
inline int between(float at, float along, float low, float high, wt_part* part) {
  if (fabs(along) < 1e-12f) return at >= low && at <= high;
  const float a = (low - at) / along, b = (high - at) / along;
  part->begin = fmax(part->begin, fmin(a, b));
  part->end = fmin(part->end, fmax(a, b));
  return part->begin <= part->end;
}

// Enters the chain for a listener, from its last surface to its first.
inline void enter(uint listener, const uint* chain, uint depth, uint wedge, uint quarter, global ulong* table,
                  global uint* quarters, global wt_counters* counters, wt_hear_arguments args) {
  uint node = WT_ROOT | (args.first_listener + listener);
  for (uint k = depth; k-- > 0;) node = wt_trie_insert(table, args.trie_mask, node, chain[k]);
  node = wt_trie_insert(table, args.trie_mask, node, WT_HEARD_WEDGE | wedge);
  if (node == WT_NONE) atomic_or(&counters->trie_overflow, 1u);
  wt_note_quarters(quarters, node, quarter);
}

// One ray per work-item. met: the trie of the rays, whose roots are edges. listeners: that of each square, row by row,
// or WT_NONE; heights: two for each square, the lowest and the highest of its receivers.
kernel void hear(const global float* rays, const global float* hits, const global ulong* met,
                 const global uint* listeners, const global float* heights, global ulong* table, global uint* quarters,
                 global wt_counters* counters, wt_hear_arguments args) {
  const uint i = get_global_id(0);
  if (i >= args.ray_count) return;
  const int ends = wt_load_word(hits, args.capacity, WT_HIT_PRIMITIVE, i) != WT_NONE;
  wt_part part = {wt_load_float3(rays, args.capacity, WT_RAY_ORIGIN, i),
                  wt_load_float3(rays, args.capacity, WT_RAY_DIRECTION, i), 0.0f, ends ? hits[i] : 1e7f};
  const float3 o = part.from, d = part.along;
  const float size = args.size;
  if (!between(o.z, d.z, args.low - args.margin, args.high + args.margin, &part) ||
      !between(o.x, d.x, args.x, args.x + size * (float)args.columns, &part) ||
      !between(o.y, d.y, args.y, args.y + size * (float)args.rows, &part))
    return;
  const uint word = wt_load_word(rays, args.capacity, WT_RAY_NODE, i), node = wt_node_of(word);
  if (node == WT_NONE) return;
  uint chain[WT_MAX_DEPTH], root;
  const uint depth = wt_chain(met, node, chain, &root);
  // The squares in the order of the ray.
  const int step_x = d.x > 0.0f ? 1 : -1, step_y = d.y > 0.0f ? 1 : -1;
  int x = clamp((int)floor((o.x + part.begin * d.x - args.x) / size), 0, (int)args.columns - 1);
  int y = clamp((int)floor((o.y + part.begin * d.y - args.y) / size), 0, (int)args.rows - 1);
  for (float t = part.begin; x >= 0 && y >= 0 && x < (int)args.columns && y < (int)args.rows;) {
    const float next_x = d.x == 0.0f ? INFINITY : (args.x + size * (float)(x + (step_x > 0 ? 1 : 0)) - o.x) / d.x;
    const float next_y = d.y == 0.0f ? INFINITY : (args.y + size * (float)(y + (step_y > 0 ? 1 : 0)) - o.y) / d.y;
    const float next = fmin(fmin(next_x, next_y), part.end), z = o.z + t * d.z, next_z = o.z + next * d.z;
    const uint square = (uint)y * args.columns + (uint)x, listener = listeners[square];
    if (listener != WT_NONE && fmin(z, next_z) <= heights[2 * square + 1] + args.margin &&
        fmax(z, next_z) >= heights[2 * square] - args.margin)
      enter(listener, chain, depth, root - args.roots, wt_quarter_bit(word), table, quarters, counters, args);
    if (next >= part.end) return;
    t = next;
    if (next_x <= next_y)
      x += step_x;
    else
      y += step_y;
  }
}
