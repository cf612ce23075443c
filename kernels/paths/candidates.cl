// SPDX-License-Identifier: Apache-2.0
// candidates: tests every sequence with every receiver, and rejects pairs in float32 where the last reflection surely
// misses its surface, then in double where a reflection misses the box of its surface. Roots (lines of sight) are
// always candidates. It is conservative: each bound covers the rounding of everything it is computed from. Only
// sequences of transmitters below transmitter_count and of at most max_reflections surfaces count, since the trie may
// also hold those of other ends, and longer prefixes. nodes[] holds the roots first, then the trie's nodes
// (lib/count.clh), at most node_count. Receivers come in groups of 16 near ones (host/passes/receiver_groups.hpp): a
// group whose box the beam of a sequence surely misses is rejected as a whole.
#include "lib/beam.clh"
#include "lib/count.clh"
#pragma OPENCL FP_CONTRACT OFF

#ifdef WT_CPU
// Makes a bit of each lane.
inline uint bits_of(int8 m) {
  const int8 b = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int4 b4 = b.lo | b.hi;
  const int2 b2 = b4.lo | b4.hi;
  return (uint)(b2.x | b2.y);
}

inline uint lowest_bit(uint bits) { return popcount((bits & (~bits + 1)) - 1u); }

// Receivers that wait for the last test, which is made for eight at once.
typedef struct {
  double x[8], y[8], z[8];
  uint receiver[8];
  uint count;
} waiting_receivers;

// Makes candidates of those that pass the last test. Places from `count` on are tested, too, but not used.
inline void test_waiting(waiting_receivers* w, const wt_followed* s, const global wt_exact_surface* exact,
                         const global wt_surface* surfaces, uint node, global wt_candidate* out,
                         global wt_counters* counters, uint capacity) {
  char keep[8];
  vstore8(wt_in_boxes8(s, exact, surfaces, vload8(0, w->x), vload8(0, w->y), vload8(0, w->z)), 0, keep);
  uint kept = 0;
  for (uint k = 0; k < w->count; ++k) {
    w->receiver[kept] = w->receiver[k];
    kept += keep[k] != 0;
  }
  w->count = 0;
  const uint first = kept ? atomic_add(&counters->candidates, kept) : 0u;
  for (uint k = 0; k < kept && first + k < capacity; ++k) {
    out[first + k].node = node;
    out[first + k].receiver = w->receiver[k];
  }
}

// One sequence per work-item; its receivers come in groups of 16 (host/passes/receiver_groups.hpp), and eight are
// tested at once. order: the receiver at each place of the groups; places: three planes of their coordinates; boxes:
// see wt_meets_beam; links: for each transmitter the wanted places of each group. args.receiver_capacity: the number of
// all places.
kernel void candidates(const global ulong* table, const global uint* nodes, const global double4* transmitters,
                       const global double4* exact_receivers, const global wt_exact_surface* exact,
                       const global wt_surface* surfaces, const global uint* order, const global float* places,
                       const global float* boxes, const global ushort* links, global wt_candidate* out,
                       global wt_counters* counters, wt_candidates_arguments args) {
  const uint i = get_global_id(0), stride = args.receiver_capacity, groups = stride / 16;
  const uint node_count = wt_node_count(counters, args.node_count);
  if (i >= node_count) return;
  wt_chains_prefetch(table, nodes, i, node_count);
  wt_followed s;
  if (!wt_follow_back(table, nodes[i], transmitters, exact, surfaces, args, &s)) return;
  wt_beam beam;
  if (s.depth > 0) beam = wt_beam_of(&s);
  waiting_receivers waiting;
  waiting.count = 0;
  const global ushort* wanted = links + (size_t)s.transmitter * groups;
  for (uint first = 0; first < groups; first += 8) {
    uint near = bits_of(convert_int8(vload8(0, wanted + first)) != 0);
    if (near && s.depth > 0) near &= bits_of(wt_meets_beam(&beam, boxes + first, groups));
    for (; near; near &= near - 1) {
      const uint group = first + lowest_bit(near);
      uint keep = wanted[group];
      if (s.depth > 0) {
        const global float* at = places + 16 * group;
        const int16 reached =
            wt_may_reach(&s, vload16(0, at), vload16(0, at + stride), vload16(0, at + 2 * (size_t)stride));
        keep &= bits_of(reached.lo) | bits_of(reached.hi) << 8;
      }
      for (; keep; keep &= keep - 1) {
        const uint receiver = order[16 * group + lowest_bit(keep)], k = waiting.count++;
        const double4 at = exact_receivers[receiver];
        waiting.receiver[k] = receiver;
        waiting.x[k] = at.x;
        waiting.y[k] = at.y;
        waiting.z[k] = at.z;
        if (k == 7) test_waiting(&waiting, &s, exact, surfaces, nodes[i], out, counters, args.capacity);
      }
    }
  }
  if (waiting.count > 0) test_waiting(&waiting, &s, exact, surfaces, nodes[i], out, counters, args.capacity);
}
#else
#include "lib/receiver_walk.clh"

// Makes the second test for the receivers that wait, and candidates of those that pass.
inline void test_waiting(uint count, const local wt_followed* sequences, const global uint* nodes,
                         const global wt_exact_surface* exact, const global wt_surface* surfaces,
                         const wt_receiver_tables* t, const local wt_receiver_queues* q, global wt_candidate* out,
                         global wt_counters* counters, uint capacity) {
  for (uint k = get_local_id(0); k < count; k += WT_GROUP) {
    const uint n = q->waiting[k] >> WT_PLACE_BITS, receiver = t->order[q->waiting[k] & WT_LOW_BITS];
    if (!wt_in_boxes(sequences + n, exact, surfaces, t->exact[receiver].xyz)) continue;
    const uint slot = atomic_inc(&counters->candidates);
    if (slot >= capacity) continue;
    out[slot].node = nodes[n];
    out[slot].receiver = receiver;
  }
}

// WT_NODES sequences per work-group; the other arguments are those of the kernel for CPUs.
__attribute__((reqd_work_group_size(WT_GROUP, 1, 1))) kernel void candidates(
    const global ulong* table, const global uint* nodes, const global double4* transmitters,
    const global double4* exact_receivers, const global wt_exact_surface* exact, const global wt_surface* surfaces,
    const global uint* order, const global float* places, const global float* boxes, const global ushort* links,
    global wt_candidate* out, global wt_counters* counters, wt_candidates_arguments args) {
  local wt_followed sequences[WT_NODES];
  local wt_receiver_queues q;
  local uint unfinished[2];
  const uint lane = get_local_id(0), first_node = get_group_id(0) * WT_NODES;
  const uint all = wt_node_count(counters, args.node_count), count = min((uint)WT_NODES, all - min(first_node, all));
  const wt_receiver_tables t = {
      order, places, boxes, links, exact_receivers, args.receiver_capacity, args.receiver_capacity / 16};
  for (uint n = lane; n < count; n += WT_GROUP)
    if (!wt_follow_back(table, nodes[first_node + n], transmitters, exact, surfaces, args, sequences + n))
      sequences[n].transmitter = WT_NONE;
  if (lane == 0) q.near_count = q.waiting_count = unfinished[0] = unfinished[1] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);

  wt_group_walk w = {.n = lane / WT_TEAM, .first = 0};
  wt_begin_group_walk(&w, sequences, count);
  uint more = 1;
  for (uint turn = 0; more; turn ^= 1) {
    for (uint round = 0; round < WT_ROUND && w.n < count; ++round) wt_look_at_group(&w, sequences, count, &t, &q);
    if (w.n < count) unfinished[turn] = 1;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint near = q.near_count;
    more = unfinished[turn];
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane == 0) unfinished[turn] = 0;  // no lane writes it before the next barrier
    if (near < WT_MANY_NEAR && more) continue;
    for (uint first = 0; first < near; first += WT_MANY_NEAR) {
      wt_test_groups(first, min(first + WT_MANY_NEAR, near), sequences, &t, &q);
      barrier(CLK_LOCAL_MEM_FENCE);
      const uint waiting = q.waiting_count;
      barrier(CLK_LOCAL_MEM_FENCE);
      if (waiting < WT_MANY_WAITING) continue;
      test_waiting(waiting, sequences, nodes + first_node, exact, surfaces, &t, &q, out, counters, args.capacity);
      if (lane == 0) q.waiting_count = 0;
      barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (lane == 0) q.near_count = 0;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  test_waiting(q.waiting_count, sequences, nodes + first_node, exact, surfaces, &t, &q, out, counters, args.capacity);
}
#endif
