// candidates: every sequence against every receiver, rejected in float32 where the last reflection surely misses its
// surface, then in double where a reflection misses the box of its surface. Roots (lines of sight) are candidates
// always. Conservative: each bound covers the rounding of everything it is computed from.
#include "lib/reflections.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Which of 16 receivers the sequence with this image of the transmitter may reach by its last surface; a: how far the
// image lies above that. A bit each. receivers: three planes of receiver_capacity floats, from the first of the 16 on.
inline uint may_reach(const global wt_surface* s, float ix, float iy, float iz, float a, const global float* receivers,
                      uint receiver_capacity) {
  // The leg from the image to a receiver crosses the last plane at distance fractions |a| : |b|. An error e of a, b
  // moves the crossing by up to (|leg| + ...) e / (|a| + |b|) along the plane.
  const float16 x = vload16(0, receivers), y = vload16(0, receivers + receiver_capacity);
  const float16 z = vload16(0, receivers + 2 * (size_t)receiver_capacity);
  const float16 b = s->normal[0] * x + s->normal[1] * y + s->normal[2] * z - s->offset;
  const float16 size = fabs(x) + fabs(y) + fabs(z) + (fabs(ix) + fabs(iy) + fabs(iz) + fabs(s->offset));
  const float16 error = 1e-6f * size;
  const float16 legs = fabs(a) + fabs(b);
  const float16 u = fabs(a) / legs;
  const float16 margin = error * (4.0f + 2.0f * size / legs) + 1e-3f;
  const float16 px = ix + u * (x - ix), py = iy + u * (y - iy), pz = iz + u * (z - iz);
  const int16 opposite = (a > 0.0f ? b : -b) <= error;
  const int16 inside = (px >= s->lower[0] - margin) & (px <= s->upper[0] + margin) & (py >= s->lower[1] - margin) &
                       (py <= s->upper[1] + margin) & (pz >= s->lower[2] - margin) & (pz <= s->upper[2] + margin);
  const int16 unsure = !(legs > 4.0f * error);
  int accepted[16];
  vstore16(opposite & (inside | unsure), 0, accepted);
  uint mask = 0;
  for (int k = 0; k < 16; ++k) mask |= (accepted[k] != 0 ? 1u : 0u) << k;
  return mask;
}

// Of the receivers of a mask, those for which every reflection may lie in the box of its surface.
inline uint in_boxes(const global wt_exact_surface* exact, const global wt_surface* surfaces, const uint* chain,
                     uint depth, const double3* images, const global double4* receivers, uint keep) {
  uint out = 0;
  for (uint rest = keep; rest; rest &= rest - 1) {
    const uint bit = rest & (~rest + 1);
    if (wt_reflects_in_boxes(exact, surfaces, chain, depth, images, receivers[popcount(bit - 1u)].xyz)) out |= bit;
  }
  return out;
}

// Of transmitters below transmitter_count alone, and of at most max_reflections surfaces: the trie may hold what other
// ends see, and longer prefixes. One sequence and `groups_per_item` groups of 16 receivers per work-item. nodes[] holds
// the roots first, then the trie's nodes. receivers: three planes of receiver_capacity floats, padded to a multiple of
// 16 with copies of the last one. links: a mask of the wanted receivers for each transmitter and 16 receivers.
kernel void candidates(const global ulong* table, const global uint* nodes, const global double4* transmitters,
                       const global double4* exact_receivers, const global wt_exact_surface* exact,
                       const global wt_surface* surfaces, const global float* receivers, const global ushort* links,
                       global wt_candidate* out, global wt_counters* counters, wt_candidates_arguments args) {
  const uint groups = args.receiver_capacity / 16, items = (groups + args.groups_per_item - 1) / args.groups_per_item;
  const uint i = get_global_id(0) / items, first = get_global_id(0) % items * args.groups_per_item;
  if (i >= args.node_count) return;
  uint chain[WT_MAX_DEPTH], transmitter;
  const uint depth = wt_chain(table, nodes[i], chain, &transmitter);
  if (transmitter >= args.transmitter_count || depth > args.max_reflections) return;
  double3 images[WT_MAX_DEPTH + 1];
  images[0] = transmitters[transmitter].xyz;
  for (uint k = 0; k < depth; ++k) images[k + 1] = wt_reflected(exact + chain[k], images[k]);
  const double3 image = images[depth];
  const uint last = depth > 0 ? chain[depth - 1] : 0u;
  const float above = (float)wt_above(exact + last, image);

  for (uint group = first; group < min(first + args.groups_per_item, groups); ++group) {
    uint keep = links[(size_t)transmitter * groups + group];
    if (keep == 0) continue;
    if (depth > 0) {
      keep &= may_reach(surfaces + last, (float)image.x, (float)image.y, (float)image.z, above, receivers + 16 * group,
                        args.receiver_capacity);
      keep = in_boxes(exact, surfaces, chain, depth, images, exact_receivers + 16 * group, keep);
    }
    uint slot = keep ? atomic_add(&counters->candidates, popcount(keep)) : 0u;
    for (; keep; keep &= keep - 1, ++slot) {
      if (slot >= args.capacity) continue;
      out[slot].node = nodes[i];
      out[slot].receiver = 16 * group + popcount((keep & (~keep + 1)) - 1u);
    }
  }
}
