// SPDX-License-Identifier: Apache-2.0
// candidates: finds the receivers that each sequence may reach. It rejects boxes of receivers outside of the beam of
// the sequence (lib/beam.clh) and pairs whose last reflection surely misses its surface, in float32, then pairs in
// double where a reflection misses the box of its surface. Roots (lines of sight) are always candidates. It is
// conservative: each bound covers the rounding of everything it is computed from. Only sequences of transmitters below
// transmitter_count and of at most max_reflections surfaces count, since the trie may also hold those of other ends,
// and longer prefixes. nodes[] holds the roots first, then the trie's nodes (lib/count.clh), at most node_count.
// Receivers come in groups of 16 near ones, and areas of 16 groups (host/passes/receiver_groups.hpp), which have a box
// each.
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

#define TOGETHER 256u  // candidates that are written together: their paths are near each other (lib/leg_packet.clh)

// Receivers that wait for the last test, which is made for eight at once, and those that have passed it.
typedef struct {
  double x[8], y[8], z[8];
  uint receiver[8];
  uint count, passed_count;
  uint passed[TOGETHER];
} waiting_receivers;

// Makes candidates of the receivers that have passed the last test.
inline void write_passed(waiting_receivers* w, uint node, global wt_candidate* out, global wt_counters* counters,
                         uint capacity) {
  const uint first = w->passed_count ? atomic_add(&counters->candidates, w->passed_count) : 0u;
  for (uint k = 0; k < w->passed_count && first + k < capacity; ++k) {
    out[first + k].node = node;
    out[first + k].receiver = w->passed[k];
  }
  w->passed_count = 0;
}

// Makes the last test. Places from `count` on are tested, too, but not used.
inline void test_waiting(waiting_receivers* w, const wt_followed* s, const global wt_exact_surface* exact,
                         const global wt_surface* surfaces, uint node, global wt_candidate* out,
                         global wt_counters* counters, uint capacity) {
  char keep[8];
  vstore8(wt_in_boxes8(s, exact, surfaces, vload8(0, w->x), vload8(0, w->y), vload8(0, w->z)), 0, keep);
  for (uint k = 0; k < w->count; ++k) {
    w->passed[w->passed_count] = w->receiver[k];
    w->passed_count += keep[k] != 0;
  }
  w->count = 0;
  if (w->passed_count + 8 >= TOGETHER) write_passed(w, node, out, counters, capacity);
}

// The places of a group that pass the first test, a bit each. places: the first; three planes of `stride`.
inline uint near_places(const wt_followed* s, const global float* places, size_t stride) {
  if (s->depth == 0) return 0xFFFFu;
  const int16 reached =
      wt_may_reach(s, vload16(0, places), vload16(0, places + stride), vload16(0, places + 2 * stride));
  return bits_of(reached.lo) | bits_of(reached.hi) << 8;
}

// One sequence per work-item; its receivers come in areas and groups, and eight boxes are tested at once. order: the
// receiver at each place of the groups; places: three planes of their coordinates; boxes, areas: see wt_meets_beam;
// links: for each transmitter the wanted places of each group. args.receiver_capacity: the number of all places.
kernel void candidates(const global ulong* table, const global uint* nodes, const global double4* transmitters,
                       const global double4* exact_receivers, const global wt_exact_surface* exact,
                       const global wt_surface* surfaces, const global uint* order, const global float* places,
                       const global float* boxes, const global float* areas, const global ushort* links,
                       global wt_candidate* out, global wt_counters* counters, wt_candidates_arguments args) {
  const uint i = get_global_id(0), stride = args.receiver_capacity, groups = stride / 16;
  const uint node_count = wt_node_count(counters, args.node_count);
  if (i >= node_count) return;
  wt_chains_prefetch(table, nodes, i, node_count);
  wt_followed s;
  if (!wt_follow_back(table, nodes[i], transmitters, exact, surfaces, args, &s)) return;
  wt_beam beam;
  const uint mirrors = wt_beam_mirrors(s.depth, groups), area_stride = wt_area_stride(groups);
  if (s.depth > 0) wt_begin_beam(&s, &beam);
  for (uint k = 0; k < mirrors; ++k) wt_mirror_sides(&s, exact, surfaces, s.depth - 1 - k, &beam);
  waiting_receivers waiting;
  waiting.count = waiting.passed_count = 0;
  const global ushort* wanted = links + (size_t)s.transmitter * groups;
  for (uint first_area = 0; 16 * first_area < groups; first_area += 8) {
    uint near_areas = groups > WT_FEW_GROUPS ? 0xFFu : 1u;
    if (s.depth > 0 && groups > WT_FEW_GROUPS)
      near_areas = bits_of(wt_meets_beam(&beam, mirrors, areas + first_area, area_stride));
    for (; near_areas; near_areas &= near_areas - 1) {
      const uint area = first_area + lowest_bit(near_areas), end = min(16 * area + 16, groups);
      for (uint first = 16 * area; first < end; first += 8) {
        uint near = bits_of(convert_int8(vload8(0, wanted + first)) != 0);
        if (near && s.depth > 0) near &= bits_of(wt_meets_beam(&beam, mirrors, boxes + first, groups));
        for (; near; near &= near - 1) {
          const uint group = first + lowest_bit(near);
          for (uint keep = wanted[group] & near_places(&s, places + 16 * group, stride); keep; keep &= keep - 1) {
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
    }
  }
  if (waiting.count > 0) test_waiting(&waiting, &s, exact, surfaces, nodes[i], out, counters, args.capacity);
  write_passed(&waiting, nodes[i], out, counters, args.capacity);
}
#else
#include "lib/receiver_walk.clh"

// Makes candidates of the last words of the last queue, one per lane, from `slot` on.
inline void write_found(uint first, uint count, const local wt_receiver_queues* q, const global uint* nodes, uint slot,
                        global wt_candidate* out, uint capacity) {
  const uint lane = get_local_id(0);
  if (lane >= count || slot + lane >= capacity) return;
  const uint word = q->words[WT_FOUND][first + lane];
  out[slot + lane].node = nodes[word >> WT_PLACE_BITS];
  out[slot + lane].receiver = word & WT_LOW_BITS;
}

// Follows the sequences back, and makes their beams.
inline void begin_sequences(uint count, local wt_sequences* s, uint groups, const global ulong* table,
                            const global uint* nodes, const global double4* transmitters,
                            const global wt_exact_surface* exact, const global wt_surface* surfaces,
                            wt_candidates_arguments args) {
  for (uint n = get_local_id(0); n < count; n += WT_GROUP) {
    if (!wt_follow_back(table, nodes[n], transmitters, exact, surfaces, args, s->ways + n)) {
      s->ways[n].transmitter = WT_NONE;
      s->ways[n].depth = 0;
    }
    if (s->ways[n].depth > 0) wt_begin_beam(s->ways + n, s->beams + n);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = get_local_id(0); i < count * WT_BEAM_MIRRORS; i += WT_GROUP) {
    const uint n = i / WT_BEAM_MIRRORS, k = i % WT_BEAM_MIRRORS, depth = s->ways[n].depth;
    if (k < wt_beam_mirrors(depth, groups)) wt_mirror_sides(s->ways + n, exact, surfaces, depth - 1 - k, s->beams + n);
  }
}

// args.nodes_together sequences per work-group, with one of args.parts parts of the receivers; the other arguments are
// those of the kernel for CPUs.
__attribute__((reqd_work_group_size(WT_GROUP, 1, 1))) kernel void candidates(
    const global ulong* table, const global uint* nodes, const global double4* transmitters,
    const global double4* exact_receivers, const global wt_exact_surface* exact, const global wt_surface* surfaces,
    const global uint* order, const global float* places, const global float* boxes, const global float* areas,
    const global ushort* links, global wt_candidate* out, global wt_counters* counters, wt_candidates_arguments args) {
  local wt_sequences s;
  local wt_receiver_queues q;
  local uint slot;
  const uint lane = get_local_id(0), number = get_group_id(0), part = number % args.parts;
  const uint first_node = number / args.parts * args.nodes_together;
  const uint all = wt_node_count(counters, args.node_count);
  const uint count = min(args.nodes_together, all - min(first_node, all)), groups = args.receiver_capacity / 16;
  if (count == 0) return;
  const wt_receiver_tables t = {order, places, boxes, areas, links, exact_receivers, args.receiver_capacity, groups};
  if (lane < WT_STAGES) q.counts[lane] = 0;
  begin_sequences(count, &s, groups, table, nodes + first_node, transmitters, exact, surfaces, args);

  // Boxes of the first stage: areas, or groups where these are few.
  const int few = groups <= WT_FEW_GROUPS;
  const uint boxes_of_all = few ? groups : (groups + 15) / 16;
  const uint each = (boxes_of_all + args.parts - 1) / args.parts;
  const uint begin = min(part * each, boxes_of_all), here = min(each, boxes_of_all - begin);
  for (uint next = 0;;) {
    barrier(CLK_LOCAL_MEM_FENCE);
    const int more = next < count * here;
    const uint stage = wt_next_stage(&q, more);
    if (stage == WT_STAGES && !more) break;
    const uint each_word = stage < WT_STAGES ? wt_lanes_of_word(stage) : 1;
    const uint waiting = stage < WT_STAGES ? q.counts[stage] : 0, taken = min(waiting, WT_GROUP / each_word);
    if (stage == WT_FOUND && lane == 0) slot = atomic_add(&counters->candidates, taken);
    barrier(CLK_LOCAL_MEM_FENCE);
    if (stage == WT_STAGES) {
      const uint i = next + lane, n = i / here, box = begin + i % here;
      if (n < count && few) wt_look_at_group(n, box, &s, &t, &q);
      if (n < count && !few) wt_look_at_area(n, box, &s, &t, &q);
      next += WT_GROUP;
      continue;
    }
    if (lane == 0) q.counts[stage] = waiting - taken;
    if (stage == WT_FOUND) {
      write_found(waiting - taken, taken, &q, nodes + first_node, slot, out, args.capacity);
    } else if (lane / each_word < taken) {
      const uint word = q.words[stage][waiting - taken + lane / each_word];
      const uint n = word >> WT_PLACE_BITS, at = (word & WT_LOW_BITS) * each_word + lane % each_word;
      if (stage == WT_AREAS) wt_look_at_group(n, at, &s, &t, &q);
      if (stage == WT_GROUPS) wt_look_at_place(n, at, &s, &t, &q);
      if (stage == WT_RECEIVERS) wt_look_closely(n, at, &s, &t, exact, surfaces, &q);
    }
  }
}
#endif
