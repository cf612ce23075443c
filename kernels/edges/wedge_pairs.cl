// SPDX-License-Identifier: Apache-2.0
// wedge_pairs: candidates of paths over two wedges, straight from one to the other: every prefix of a transmitter with
// every one of the other end that sees another wedge, both convex, if pieces that they see may see each other. Results
// about two static wedges are kept as long as the scene is.
#include "lib/join.clh"
#include "lib/memory_order.clh"
#include "lib/prefix_group.clh"
#include "lib/sight.clh"
#include "wavetracer/device/arguments.h"

// Does some part of the other wedge lie in the free sector of this one?
inline int may_see(const global wt_wedge* w, const global wt_wedge* other) {
  return wt_in_sector(w, wt_in_wedge(w, wt_on_edge(other, 0.0)), 0.0) ||
         wt_in_sector(w, wt_in_wedge(w, wt_on_edge(other, other->length)), 0.0);
}

// Corners do not count here: there are many, and the waves that they diffract are faint.
inline int is_corner(const global wt_wedge* w) { return w->sine > 0.0; }

// Does the way from one to the other run in the free space of both wedges, or along a face of both?
inline int in_sight(const global wt_wedge* v, const global wt_wedge* w) {
  return wt_share_plane(v, w, (double3)(0.0, 0.0, 0.0)) || (may_see(v, w) && may_see(w, v));
}

// The knowledge of two wedges: bits 0 to 15 are the pairs of pieces that were tested, bits 16 to 31 those that may see
// each other; bit WT_WEDGE_PIECES i + j is for piece i of the wedge with the lower number and j of the other.
#define ALL_PAIRS 0xFFFFu

inline uint pairs_of(uint pieces_low, uint pieces_high) {
  uint out = 0;
  for (uint i = 0; i < WT_WEDGE_PIECES; ++i)
    if (pieces_low >> i & 1u) out |= pieces_high << WT_WEDGE_PIECES * i;
  return out;
}

// Tests wanted pairs of pieces until it finds one that may see each other. Returns what is known now.
inline uint look(const wt_sight* sight, const global wt_wedge* low, const global wt_wedge* high, uint wanted,
                 uint known, wt_hiders* hiders) {
  const double a = low->length / WT_WEDGE_PIECES, b = high->length / WT_WEDGE_PIECES;
  for (uint left = wanted & ~known; left && !(known >> 16 & wanted); left &= left - 1) {
    const uint bit = 31u - clz(left & -left), i = bit / WT_WEDGE_PIECES, j = bit % WT_WEDGE_PIECES;
    const wt_lines l = {wt_on_edge(low, i * a),
                        wt_on_edge(low, (i + 1) * a),
                        wt_on_edge(high, j * b),
                        wt_on_edge(high, (j + 1) * b),
                        0,
                        1e-3};
    known |= (wt_hidden(sight, &l, hiders) ? 1u : 0x10001u) << bit;
  }
  return known;
}

// One sorted key per work-item. A run is the prefixes that see one wedge: heads[i] becomes i where one begins, else
// WT_NONE. Runs of corners are left out; prefixes that see nothing have the last keys and are in no run.
kernel void mark_runs(const global uint* keys, const global wt_wedge* wedges, global uint* heads, uint count) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const int begins = keys[i] != WT_NONE && (i == 0 || wt_wedge_of(keys[i - 1]) != wt_wedge_of(keys[i]));
  heads[i] = begins && !is_corner(wedges + wt_wedge_of(keys[i])) ? i : WT_NONE;
}

// The knowledge of wedge a of a group and another wedge b, as look() returns it: ALL_PAIRS where no path goes from one
// to the other, 0 where nothing is known.
inline uint known_of(const global uint* kept, uint kept_wedges, uint a, uint b) {
  if (a == b) return ALL_PAIRS;
  return max(a, b) < kept_wedges ? wt_load_relaxed_u32(kept + (size_t)a * kept_wedges + b) : 0;
}

#define RUNS_AHEAD 16u  // keys are read ahead of their use

// `lanes` work-items take each group of prefixes of a block, and each of them a part of the runs. runs: the start of
// each run of the sorted keys; kept: the knowledge of each static wedge with each other one.
kernel void wedge_pairs(const global WT_NODE* nodes, const global WT_LEAF* triangles,
                        const global wt_exact_surface* surfaces, const global uint* first_sides,
                        const global double* sides, global uint* kept, const global uint* keys, const global uint* runs,
                        const global wt_wedge_prefix* prefixes, const global uint* receiver_of_end,
                        const global ushort* links, const global wt_wedge* wedges, global wt_wedge_candidate* out,
                        global wt_counters* counters, wt_wedge_join_arguments args, wt_sight_arguments sight_args,
                        uint run_count) {
  const uint i = args.first + get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.end || keys[i] == WT_NONE) return;
  const uint wedge_a = wt_wedge_of(keys[i]);
  const global wt_wedge* v = wedges + wedge_a;
  wt_prefix_group group;
  if (is_corner(v) || !wt_begins_group(keys, prefixes, args, i, &group)) return;
  const wt_sight sight = {nodes,       triangles, sight_args.triangle_slots,  sight_args.extent_m,   surfaces,
                          first_sides, sides,     sight_args.static_surfaces, sight_args.only_opaque};
  wt_found_candidates batch;
  batch.count = 0;
  wt_hiders hiders = {{WT_NONE, WT_NONE, WT_NONE, WT_NONE}};
  for (uint r = lane; r < run_count; r += args.lanes) {
    if (r + RUNS_AHEAD < run_count) wt_prefetch(keys + runs[r + RUNS_AHEAD]);
    const uint wedge_b = wt_wedge_of(keys[runs[r]]), last = wt_wedge_key(wedge_b, group.most);
    const uint was_known = known_of(kept, sight_args.kept_wedges, wedge_a, wedge_b);
    const global wt_wedge* w = wedges + wedge_b;
    if (was_known == ALL_PAIRS) continue;
    const wt_edge_view ahead = wt_edge_seen_from(v, w);
    if (!wt_leave_pieces(v, &ahead, &group)) continue;
    const int a_is_low = wedge_a < wedge_b;
    const global wt_wedge *low = a_is_low ? v : w, *high = a_is_low ? w : v;
    uint known = was_known || in_sight(low, high) ? was_known : ALL_PAIRS;
    const uint end = known == ALL_PAIRS ? 0 : args.count;
    const wt_edge_view back = wt_edge_seen_from(w, v);
    const float length_b = (float)w->length;
    wt_pair_floor pair = {0, 0, 0.0f, 0.0f, (float2)(0.0f), (float2)(0.0f)};
    for (uint j = runs[r]; j < end && keys[j] <= last; ++j) {
      const global wt_wedge_prefix* b = prefixes + j;
      const uint pieces_b = b->pieces & wt_crossed_pieces(length_b, b->along, b->away, b->first, b->final, &back);
      float power_b = NAN;
      for (uint k = 0; pieces_b && k < group.count; ++k) {
        const global wt_wedge_prefix* a = prefixes + group.numbers[k];
        const uint pieces_a = group.pieces[k];
        const uint receiver = wt_wanted_receiver(a, b, 2, args.max_depth, receiver_of_end, links, args.groups);
        if (!pieces_a || receiver == WT_NONE) continue;
        const uint wanted = pairs_of(a_is_low ? pieces_a : pieces_b, a_is_low ? pieces_b : pieces_a);
        if (!(wanted & (known >> 16 | ~known))) continue;
        if (args.floor > 0.0f && wt_is_weak_pair(prefixes, v, w, b, k, args.floor, &back, &pair, &group, &power_b))
          continue;
        if (!wt_may_bend(v, w, a, b)) continue;
        known = look(&sight, low, high, wanted, known, &hiders);
        if (known >> 16 & wanted)
          wt_emit_candidate(a->node, b->node, wedge_a, wedge_b, receiver, a->quarters & b->quarters, &batch, out,
                            args.capacity, counters);
      }
    }
    if (known != was_known && max(wedge_a, wedge_b) < sight_args.kept_wedges) {
      atomic_or(kept + (size_t)wedge_a * sight_args.kept_wedges + wedge_b, known);
      atomic_or(kept + (size_t)wedge_b * sight_args.kept_wedges + wedge_a, known);
    }
  }
  wt_list_candidates(&batch, out, args.capacity, counters);
}
