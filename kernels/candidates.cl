// candidates: every sequence against every receiver, rejected in float32 where the last reflection surely misses its
// surface, then in double where a reflection misses the box of its surface. Roots (lines of sight) are candidates
// always. Conservative: each bound covers the rounding of everything it is computed from.
// Of transmitters below transmitter_count alone, and of at most max_reflections surfaces: the trie may hold what other
// ends see, and longer prefixes. nodes[] holds the roots first, then the trie's nodes (lib/count.clh), at most
// node_count. receivers: three planes of
// receiver_capacity floats, padded to a multiple of 16 with copies of the last one. links: a mask of the wanted
// receivers for each transmitter and 16 receivers.
#include "lib/count.clh"
#include "lib/reach.clh"
#pragma OPENCL FP_CONTRACT OFF

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
  wt_followed s;
  if (i >= wt_node_count(counters, args.node_count) ||
      !wt_follow_back(table, nodes[i], transmitters, exact, surfaces, args, &s))
    return;
  for (uint group = 0; group < groups; ++group) {
    uint keep = links[(size_t)s.transmitter * groups + group];
    if (keep != 0 && s.depth > 0) {
      const global float* at = receivers + 16 * group;
      keep &= bits_of(wt_may_reach(&s, vload16(0, at), vload16(0, at + args.receiver_capacity),
                                   vload16(0, at + 2 * (size_t)args.receiver_capacity)));
      for (uint rest = keep; rest; rest &= rest - 1) {
        const uint bit = lowest_bit(rest);
        if (!wt_in_boxes(&s, exact, surfaces, exact_receivers[16 * group + popcount(bit - 1u)].xyz)) keep &= ~bit;
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
#define WT_TEAM 32u  // lanes that take the receivers of one sequence

// Where a lane has come to: its place among the links of sequence n, and the first place of its team.
typedef struct {
  uint n, place, team;
} walk;

// The next sequence of the team that has links left.
inline void step_on(walk* w, const local uint* link_counts, uint count, uint lane) {
  while (w->n < count && w->team >= link_counts[w->n]) {
    w->n += WT_GROUP / WT_TEAM;
    w->team = 0;
  }
  w->place = w->team + lane % WT_TEAM;
}

// How many of `count` nodes a group takes that begins with `first`.
inline uint left_from(uint first, uint count) { return min((uint)WT_NODES, count - min(first, count)); }

// WT_NODES sequences per work-group with the receivers that their transmitters have links to. linked: for each
// transmitter and one more where its receivers begin, then the receivers.
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
    if (lane == 0) unfinished[turn] = 0;  // nobody writes it before the next barrier
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
