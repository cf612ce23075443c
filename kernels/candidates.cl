// candidates: every sequence against every receiver, rejected in float32 where the last reflection surely misses its
// surface. Roots (lines of sight) are candidates always. Conservative: each bound covers the rounding of everything it
// is computed from.
#include "lib/images.clh"
#pragma OPENCL FP_CONTRACT OFF

// One sequence and 16 receivers a work-item. nodes[] holds the roots first, then the trie's nodes.
// receivers: three planes of receiver_capacity floats, padded to a multiple of 16 with copies of the last one.
// links: a mask of the wanted receivers for each transmitter and 16 receivers.
kernel void candidates(const global ulong* table, const global uint* nodes, uint node_count,
                       const global double4* transmitters, const global wt_exact_surface* exact,
                       const global wt_surface* surfaces, const global float* receivers, const global ushort* links,
                       uint receiver_capacity, global wt_candidate* out, uint capacity, global wt_counters* counters) {
  const uint groups = receiver_capacity / 16;
  const uint i = get_global_id(0) / groups, group = get_global_id(0) % groups, first = group * 16;
  if (i >= node_count) return;
  const uint node = nodes[i];
  uint chain[WT_MAX_DEPTH], transmitter;
  const uint depth = wt_chain(table, node, chain, &transmitter);
  uint keep = links[(size_t)transmitter * groups + group];
  if (keep == 0) return;
  if (depth > 0) {
    double3 image = transmitters[transmitter].xyz;
    for (uint k = 0; k < depth; ++k) image = wt_reflected(exact + chain[k], image);

    // The leg from the image to a receiver crosses the last plane at distance fractions |a| : |b|. An error e of a, b
    // moves the crossing by up to (|leg| + ...) e / (|a| + |b|) along the plane.
    const global wt_surface* s = surfaces + chain[depth - 1];
    const float16 x = vload16(0, receivers + first), y = vload16(0, receivers + receiver_capacity + first);
    const float16 z = vload16(0, receivers + 2 * (size_t)receiver_capacity + first);
    const float ix = (float)image.x, iy = (float)image.y, iz = (float)image.z;
    const float a = (float)wt_above(exact + chain[depth - 1], image);
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
    keep &= mask;
  }
  const uint count = popcount(keep);
  if (count == 0) return;
  uint slot = atomic_add(&counters->candidates, count);
  for (; keep; keep &= keep - 1, ++slot) {
    if (slot < capacity) {
      out[slot].node = node;
      out[slot].back = WT_NONE;
      out[slot].receiver = first + popcount((keep & (~keep + 1)) - 1u);
    }
  }
}
