// candidates: every sequence against every receiver, rejected in float32 where the last reflection surely misses its
// surface, then in double where a reflection misses the box of its surface. Roots (lines of sight) are candidates
// always. Conservative: each bound covers the rounding of everything it is computed from.
// Of transmitters below transmitter_count alone, and of at most max_reflections surfaces: the trie may hold what other
// ends see, and longer prefixes. nodes[] holds the roots first, then the trie's nodes. receivers: three planes of
// receiver_capacity floats, padded to a multiple of 16 with copies of the last one. links: a mask of the wanted
// receivers for each transmitter and 16 receivers.
#include "lib/reflections.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

#ifdef WT_CPU
typedef float16 lanes;
typedef int16 mask;
#define WT_LOAD_LANES(from) vload16(0, from)
#define WT_SPACE private
#else
typedef float lanes;
typedef int mask;
#define WT_LOAD_LANES(from) (*(from))
#define WT_SPACE local
#endif

// The first test, of the receivers from `receivers` on: may the sequence with this last image reach them by its last
// surface?
inline mask may_reach(const global wt_surface* s, float4 image, const global float* receivers, uint receiver_capacity) {
  const float ix = image.x, iy = image.y, iz = image.z, a = image.w;
  // The leg from the image to a receiver crosses the last plane at distance fractions |a| : |b|. An error e of a, b
  // moves the crossing by up to (|leg| + ...) e / (|a| + |b|) along the plane.
  const lanes x = WT_LOAD_LANES(receivers), y = WT_LOAD_LANES(receivers + receiver_capacity);
  const lanes z = WT_LOAD_LANES(receivers + 2 * (size_t)receiver_capacity);
  const lanes b = s->normal[0] * x + s->normal[1] * y + s->normal[2] * z - s->offset;
  const lanes size = fabs(x) + fabs(y) + fabs(z) + (fabs(ix) + fabs(iy) + fabs(iz) + fabs(s->offset));
  const lanes error = 1e-6f * size;
  const lanes legs = fabs(a) + fabs(b);
  const lanes per_leg = 1.0f / legs, u = fabs(a) * per_leg;
  const lanes margin = error * (4.0f + 2.0f * size * per_leg) + 1e-3f;
  const lanes px = ix + u * (x - ix), py = iy + u * (y - iy), pz = iz + u * (z - iz);
  const mask opposite = (a > 0.0f ? b : -b) <= error;
  const mask inside = (px >= s->lower[0] - margin) & (px <= s->upper[0] + margin) & (py >= s->lower[1] - margin) &
                      (py <= s->upper[1] + margin) & (pz >= s->lower[2] - margin) & (pz <= s->upper[2] + margin);
  const mask unsure = !(legs > 4.0f * error);
  return opposite & (inside | unsure);
}

// A sequence followed back from its node. WT_REFLECTIONS: of the longest one, at least one.
typedef struct {
  double3 images[WT_REFLECTIONS + 1];
  uint chain[WT_REFLECTIONS];
  float4 last;  // the last image, and how far it lies above the last surface
  uint depth, transmitter;
} sequence;

// 0 where the sequence is no transmitter's, or too long.
inline int follow_back(const global ulong* table, uint node, const global double4* transmitters,
                       const global wt_exact_surface* exact, wt_candidates_arguments args, WT_SPACE sequence* to) {
  uint chain[WT_MAX_DEPTH], transmitter;
  const uint depth = wt_chain(table, node, chain, &transmitter);
  if (transmitter >= args.transmitter_count || depth > args.max_reflections) return 0;
  double3 image = transmitters[transmitter].xyz;
  to->images[0] = image;
  for (uint k = 0; k < depth; ++k) {
    to->chain[k] = chain[k];
    to->images[k + 1] = image = wt_reflected(exact + chain[k], image);
  }
  const float above = depth > 0 ? (float)wt_above(exact + chain[depth - 1], image) : 0.0f;
  to->last = (float4)((float)image.x, (float)image.y, (float)image.z, above);
  to->depth = depth;
  to->transmitter = transmitter;
  return 1;
}

// The second test: may every reflection on the way to a receiver lie in the box of its surface? What solve accepts
// surely may, because points are computed by the same operations.
inline int in_boxes(const WT_SPACE sequence* s, const global wt_exact_surface* exact, const global wt_surface* surfaces,
                    double3 to) {
  for (uint k = s->depth; k-- > 0;) {
    const uint next = k + 1 < s->depth ? s->chain[k + 1] : WT_NONE;
    if (!wt_mirror_point(exact, s->chain[k], next, s->images[k + 1], to, &to)) return 0;
    if (!wt_in_box(surfaces + s->chain[k], to)) return 0;
  }
  return 1;
}

#ifdef WT_CPU
// A bit for each lane.
inline uint bits_of(int16 m) {
  const int16 b = m & (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
  const int8 b8 = b.lo | b.hi;
  const int4 b4 = b8.lo | b8.hi;
  const int2 b2 = b4.lo | b4.hi;
  return (uint)(b2.x | b2.y);
}

inline uint lowest_bit(uint bits) { return bits & (~bits + 1); }

// One sequence per work-item, 16 receivers at a time.
kernel void candidates(const global ulong* table, const global uint* nodes, const global double4* transmitters,
                       const global double4* exact_receivers, const global wt_exact_surface* exact,
                       const global wt_surface* surfaces, const global float* receivers, const global ushort* links,
                       global wt_candidate* out, global wt_counters* counters, wt_candidates_arguments args) {
  const uint i = get_global_id(0), groups = args.receiver_capacity / 16;
  sequence s;
  if (i >= args.node_count || !follow_back(table, nodes[i], transmitters, exact, args, &s)) return;
  for (uint group = 0; group < groups; ++group) {
    uint keep = links[(size_t)s.transmitter * groups + group];
    if (keep != 0 && s.depth > 0) {
      keep &=
          bits_of(may_reach(surfaces + s.chain[s.depth - 1], s.last, receivers + 16 * group, args.receiver_capacity));
      for (uint rest = keep; rest; rest &= rest - 1) {
        const uint bit = lowest_bit(rest);
        if (!in_boxes(&s, exact, surfaces, exact_receivers[16 * group + popcount(bit - 1u)].xyz)) keep &= ~bit;
      }
    }
    uint slot = keep ? atomic_add(&counters->candidates, popcount(keep)) : 0u;
    for (; keep; keep &= keep - 1, ++slot) {
      if (slot >= args.capacity) continue;
      out[slot].node = nodes[i];
      out[slot].receiver = 16 * group + popcount(lowest_bit(keep) - 1u);
    }
  }
}
#else
// Pairs wait for the second test, so that all lanes make it together; at most WT_ROUND pairs a lane between two looks
// at their number.
#define WT_ROUND 4u
#define WT_WAITING (2 * WT_ROUND * WT_GROUP)
#define WT_NODE_SHIFT 24u  // in the word of a pair; receivers are below
#define WT_RECEIVER_BITS ((1u << WT_NODE_SHIFT) - 1)

// Is the pair a link, and does it pass the first test?
inline int passes(const local sequence* s, uint receiver, const global wt_surface* surfaces,
                  const global float* receivers, const global ushort* links, uint receiver_capacity) {
  if (s->depth == WT_NONE) return 0;
  if (!(links[(size_t)s->transmitter * (receiver_capacity / 16) + receiver / 16] >> receiver % 16 & 1)) return 0;
  return s->depth == 0 ||
         may_reach(surfaces + s->chain[s->depth - 1], s->last, receivers + receiver, receiver_capacity);
}

// WT_NODES sequences per work-group with all receivers.
__attribute__((reqd_work_group_size(WT_GROUP, 1, 1))) kernel void candidates(
    const global ulong* table, const global uint* nodes, const global double4* transmitters,
    const global double4* exact_receivers, const global wt_exact_surface* exact, const global wt_surface* surfaces,
    const global float* receivers, const global ushort* links, global wt_candidate* out, global wt_counters* counters,
    wt_candidates_arguments args) {
  local sequence sequences[WT_NODES];
  local uint waiting[WT_WAITING], kept[WT_WAITING], waiting_count, kept_count, first_slot;
  const uint lane = get_local_id(0), first_node = get_group_id(0) * WT_NODES;
  const uint count = min((uint)WT_NODES, args.node_count - min(first_node, args.node_count));
  for (uint n = lane; n < count; n += WT_GROUP)
    if (!follow_back(table, nodes[first_node + n], transmitters, exact, args, sequences + n))
      sequences[n].depth = WT_NONE;
  if (lane == 0) waiting_count = kept_count = 0;
  barrier(CLK_LOCAL_MEM_FENCE);

  // Neighbours take neighbouring receivers of one sequence, or of several where there are few receivers.
  const uint capacity = args.receiver_capacity, together = WT_GROUP / args.lanes;
  uint first = 0, receiver = lane % args.lanes, steps = 0;
  for (uint n = lane / args.lanes; first < count;) {
    if (n < count && receiver < capacity && passes(sequences + n, receiver, surfaces, receivers, links, capacity))
      waiting[atomic_inc(&waiting_count)] = n << WT_NODE_SHIFT | receiver;
    receiver += args.lanes;
    if (receiver - lane % args.lanes >= capacity) {
      receiver = lane % args.lanes;
      n += together;
      first += together;
    }
    if (++steps % WT_ROUND != 0 && first < count) continue;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint now = waiting_count;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (now <= WT_ROUND * WT_GROUP && first < count) continue;
    for (uint w = lane; w < now; w += WT_GROUP) {
      const uint pair = waiting[w];
      if (in_boxes(sequences + (pair >> WT_NODE_SHIFT), exact, surfaces, exact_receivers[pair & WT_RECEIVER_BITS].xyz))
        kept[atomic_inc(&kept_count)] = pair;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane == 0) {
      first_slot = atomic_add(&counters->candidates, kept_count);
      waiting_count = 0;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = lane; k < kept_count && first_slot + k < args.capacity; k += WT_GROUP) {
      out[first_slot + k].node = nodes[first_node + (kept[k] >> WT_NODE_SHIFT)];
      out[first_slot + k].receiver = kept[k] & WT_RECEIVER_BITS;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane == 0) kept_count = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
}
#endif
