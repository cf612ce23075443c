// SPDX-License-Identifier: Apache-2.0
// candidates: tests every sequence with every receiver, and rejects pairs in float32 where the last reflection surely
// misses its surface, then in double where a reflection misses the box of its surface. Roots (lines of sight) are
// always candidates. It is conservative: each bound covers the rounding of everything it is computed from. Only
// sequences of transmitters below transmitter_count and of at most max_reflections surfaces count, since the trie may
// also hold those of other ends, and longer prefixes. nodes[] holds the roots first, then the trie's nodes
// (lib/count.clh), at most node_count. On CPUs receivers come in groups of 16, elsewhere as lists of those that each
// transmitter has links to.
#include "lib/count.clh"
#include "lib/reach.clh"
#pragma OPENCL FP_CONTRACT OFF

#ifdef WT_CPU
#include "lib/beam.clh"

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
// Pairs wait for the second test, so that all lanes make it together. A lane adds at most WT_ROUND pairs before their
// number is checked again.
#define WT_ROUND 4u
#define WT_WAITING (2 * WT_ROUND * WT_GROUP)
#define WT_NODE_SHIFT 24u  // bit of the node in the word of a pair; lower bits are the receiver
#define WT_RECEIVER_BITS ((1u << WT_NODE_SHIFT) - 1)
#define WT_TEAM 32u  // lanes that share the receivers of one sequence

// The position of a lane: its place among the links of sequence n, and the first place of its team.
typedef struct {
  uint n, place, team;
} walk;

// Steps to the next sequence of the team that has links left.
inline void step_on(walk* w, const local uint* link_counts, uint count, uint lane) {
  while (w->n < count && w->team >= link_counts[w->n]) {
    w->n += WT_GROUP / WT_TEAM;
    w->team = 0;
  }
  w->place = w->team + lane % WT_TEAM;
}

// The number of nodes, out of `count`, in the group that begins with `first`.
inline uint left_from(uint first, uint count) { return min((uint)WT_NODES, count - min(first, count)); }

// WT_NODES sequences per work-group with the receivers that their transmitters have links to. receivers: three planes
// of their coordinates. linked: for each transmitter where its receivers begin, one more entry for the end, then the
// receivers.
__attribute__((reqd_work_group_size(WT_GROUP, 1, 1))) kernel void candidates(
    const global ulong* table, const global uint* nodes, const global double4* transmitters,
    const global double4* exact_receivers, const global wt_exact_surface* exact, const global wt_surface* surfaces,
    const global float* receivers, const global uint* linked, global wt_candidate* out, global wt_counters* counters,
    wt_candidates_arguments args) {
  local wt_followed sequences[WT_NODES];
  local uint first_links[WT_NODES], link_counts[WT_NODES], unfinished[2];
  local uint waiting[WT_WAITING], kept[WT_WAITING], waiting_count, kept_count, first_slot;
  const uint lane = get_local_id(0), first_node = get_group_id(0) * WT_NODES, capacity = args.receiver_capacity;
  const uint count = left_from(first_node, wt_node_count(counters, args.node_count));
  for (uint n = lane; n < count; n += WT_GROUP) {
    const int known = wt_follow_back(table, nodes[first_node + n], transmitters, exact, surfaces, args, sequences + n);
    first_links[n] = known ? linked[sequences[n].transmitter] : 0u;
    link_counts[n] = known ? linked[sequences[n].transmitter + 1] - first_links[n] : 0u;
  }
  if (lane == 0) waiting_count = kept_count = unfinished[0] = unfinished[1] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);

  walk w = {lane / WT_TEAM, 0, 0};
  step_on(&w, link_counts, count, lane);
  uint more = 1;
  for (uint turn = 0; more; turn ^= 1) {
    for (uint round = 0; round < WT_ROUND && w.n < count; ++round) {
      if (w.place < link_counts[w.n]) {
        const uint r = linked[first_links[w.n] + w.place];
        if (sequences[w.n].depth == 0 ||
            wt_may_reach(sequences + w.n, receivers[r], receivers[capacity + r], receivers[2 * (size_t)capacity + r]))
          waiting[atomic_inc(&waiting_count)] = w.n << WT_NODE_SHIFT | r;
      }
      w.team += WT_TEAM;
      step_on(&w, link_counts, count, lane);
    }
    if (w.n < count) unfinished[turn] = 1;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint now = waiting_count;
    more = unfinished[turn];
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane == 0) unfinished[turn] = 0;  // no lane writes it before the next barrier
    if (now <= WT_ROUND * WT_GROUP && more) continue;
    for (uint k = lane; k < now; k += WT_GROUP) {
      const uint pair = waiting[k];
      if (wt_in_boxes(sequences + (pair >> WT_NODE_SHIFT), exact, surfaces,
                      exact_receivers[pair & WT_RECEIVER_BITS].xyz))
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
