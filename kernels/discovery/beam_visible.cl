// SPDX-License-Identifier: Apache-2.0
// beam_visible: the parts of facets that an image sees through an aperture and that nothing hides. Each part whose
// paths are not too weak enters its sequence into the trie and becomes an aperture, unless this depth is the last. A
// group of WT_LANES work-items takes WT_TARGETS candidates; the other candidates of the aperture may hide them, and
// each lane looks at some of these. A group that has worked for long stores the pieces that are left, and beam_waiting
// goes on with each of them in a group of its own.
#include "lib/beam_results.clh"
#include "lib/trie.clh"
#pragma OPENCL FP_CONTRACT OFF

// A group does this much work for one candidate; a look at a chunk of candidates counts 1, and a cut WT_CUT_WORK. It is
// the same for all devices, because it decides which pieces are looked at once a part of a facet was seen. GPUs want
// little (docs/design/measurements.md).
#define WT_PATIENCE 32
#define WT_CUT_WORK 4

// Takes what the candidates from `next` on hide from the piece in pieces.whole. Returns 1 if it is seen as a whole;
// else it is hidden, or what is left of it waits.
inline int seen_whole(const wt_world* world, const wt_view* view, double3 apex, const wt_target* target, uint next,
                      const wt_results* out, local wt_shared* shared, wt_piece_counts* counts) {
  const wt_view_box box = wt_box_of_piece(view, target, &shared->pieces.whole, shared);
  while (next != WT_NONE) {
    if (counts->patience <= 0) {
      wt_store_waiting(out, target->candidate, next, &shared->pieces.whole, &shared->pieces.passed, shared);
      return 0;
    }
    --counts->patience;
    const uint chunk = next / WT_CHUNK, end = chunk * WT_CHUNK + world->chunks[chunk].count;
    const uint after = world->chunks[chunk].next, first_after = after == WT_NONE ? WT_NONE : after * WT_CHUNK;
    const uint found = wt_find_hider(world, view, apex, target, &box, next, end, shared);
    next = found + 1 < end ? found + 1 : first_after;
    if (found == end) continue;
    const uint wall = shared->wall;
    if (shared->covers && wall != WT_NONE) {
      wt_pass_wall(wall, &shared->pieces);
      continue;
    }
    if (shared->covers) return 0;
    if (counts->count + shared->pieces.shadow.count + 1 > WT_PIECES)
      wt_store_all_waiting(out, target->candidate, shared, counts);
    counts->patience -= WT_CUT_WORK;
    if (wt_split(next, wall, &shared->pieces, counts)) return 0;
  }
  return 1;
}

// Enters the sequence of a target into the trie: its node, or WT_NONE if there is no room.
inline uint enter(const wt_results* out, uint parent, uint surface, local wt_shared* shared) {
  if (wt_lane() == 0) {
    const uint node = wt_trie_insert(out->table, out->args.trie_mask, parent, surface);
    if (node == WT_NONE)
      out->counters->trie_overflow = 1;
    else
      wt_note_quarters(out->quarters, node, WT_ALL_QUARTERS);
    shared->node = node;
  }
  WT_SYNC();
  return shared->node;
}

// Cuts the pieces that wait until each is seen or hidden. `node`: WT_NONE until a piece is seen. Where edges diffract,
// a sequence is also entered if a part of the target was left out because it is thin: its edge may be as long as any.
inline void look(const wt_world* world, const wt_view* view, double3 apex, const wt_target* target,
                 const wt_results* out, local wt_shared* shared, wt_piece_counts* counts) {
  uint node = WT_NONE;
  while (counts->count > 0) {
    if (counts->patience <= 0) wt_store_all_waiting(out, target->candidate, shared, counts);
    if (counts->count == 0) break;
    --counts->count;
    const uint next = shared->pieces.next[counts->count];
    if (wt_lane() == 0) shared->pieces.passed = shared->pieces.walls[counts->count];
    wt_copy_polygon(shared->pieces.piece + counts->count, &shared->pieces.whole);
    if (!seen_whole(world, view, apex, target, next, out, shared, counts)) continue;
    float kept;
    if (!wt_is_followed(&out->mirrors, world->aperture->kept, apex, target, &shared->pieces.whole, &kept, counts))
      continue;
    if (node == WT_NONE) node = enter(out, world->aperture->node, target->surface, shared);
    if (node == WT_NONE || out->args.last) return;
    if (wt_lane() == 0) shared->slot = atomic_inc(&out->counters->apertures);
    WT_SYNC();
    if (shared->slot < out->args.capacity)
      wt_store_aperture(out->next + shared->slot, node, world->aperture->passed, kept, apex, target, &shared->pieces);
    WT_SYNC();
  }
  if (out->args.edges && counts->left_out > 0 && node == WT_NONE)
    enter(out, world->aperture->node, target->surface, shared);
}

// Looks at one candidate of an aperture; `from` is the piece that is left of it, or null: it is looked at for the first
// time.
inline void look_at(const wt_world* world, const global wt_lit_space* lit, uint candidate,
                    const global wt_waiting_piece* from, const wt_results* out, local wt_shared* shared) {
  const double3 apex = wt_vector(world->aperture->image);
  local wt_pieces* pieces = &shared->pieces;
  wt_view view;
  wt_load_view(lit, &view);
  wt_target target;
  wt_set_target(world, candidate, apex, &target);
  wt_piece_counts counts = {.count = 1, .patience = WT_PATIENCE, .left_out = 0, .weak = 0, .height = target.height};
  if (from) {
    for (uint k = wt_lane(); k < from->count; k += WT_LANES) wt_set_corner(pieces->piece, k, from->u[k], from->v[k]);
    if (wt_lane() == 0) {
      pieces->piece->count = from->count;
      pieces->walls[0] = from->walls;
    }
  } else {
    wt_outline o;
    wt_load_outline(world->facets + world->candidates[candidate].facet, world->corners, apex, &o);
    wt_lit_part(lit, &o, &target, pieces);
    if (wt_lane() == 0) pieces->walls[0].count = 0;
    const double sr = wt_solid_angle_bound(pieces->piece, target.height);
    counts.count = sr > WT_LEAST_SR;
    if (!(sr > WT_LEAST_SR)) counts.left_out = wt_in_sr_units(sr);
  }
  if (wt_lane() == 0) pieces->next[0] = from ? from->next : world->chunks[candidate / WT_CHUNK].first * WT_CHUNK;
  WT_SYNC();
  look(world, &view, apex, &target, out, shared, &counts);
  if (wt_lane() != 0) return;
  if (counts.weak > 0) wt_add_units(out->counters->weak, counts.weak);
  if (counts.left_out == 0) return;
  wt_add_units(out->counters->left_out, counts.left_out);
  wt_add_units(out->counters->thin, (ulong)ceil((double)counts.left_out * world->aperture->kept));
}

kernel void beam_visible(const global wt_facet* facets, const global double* corners,
                         const global wt_exact_surface* surfaces, const global wt_aperture* apertures,
                         const global wt_lit_space* lit_spaces, const global wt_chunk* chunks,
                         const global wt_beam_candidate* candidates, const global float* reflectances,
                         const global uint* materials_of, global ulong* table, global uint* quarters,
                         global wt_aperture* next, global wt_waiting_piece* waiting, global wt_beam_counters* counters,
                         wt_floor limit, wt_beam_arguments args) {
  local wt_shared shared;
  const wt_results out = {{reflectances, materials_of, limit}, table, quarters, next, waiting, counters, args};
  for (uint k = 0; k < WT_TARGETS; ++k) {
    const uint candidate = get_group_id(0) * WT_TARGETS + k, chunk = candidate / WT_CHUNK;
    if (chunk >= args.count || candidate % WT_CHUNK >= chunks[chunk].count || !candidates[candidate].use) continue;
    const uint aperture = chunks[chunk].aperture;
    if (candidates[candidate].use == WT_EDGE_ON) {
      enter(&out, apertures[aperture].node, facets[candidates[candidate].facet].surface, &shared);
      continue;
    }
    const wt_world world = {facets, corners, surfaces, apertures + aperture, chunks, candidates, args.walls};
    look_at(&world, lit_spaces + (aperture - args.first), candidate, 0, &out, &shared);
  }
}

// Goes on with the pieces that groups have left in the round before.
kernel void beam_waiting(const global wt_facet* facets, const global double* corners,
                         const global wt_exact_surface* surfaces, const global wt_aperture* apertures,
                         const global wt_lit_space* lit_spaces, const global wt_chunk* chunks,
                         const global wt_beam_candidate* candidates, const global float* reflectances,
                         const global uint* materials_of, const global wt_waiting_piece* pieces, global ulong* table,
                         global uint* quarters, global wt_aperture* next, global wt_waiting_piece* waiting,
                         global wt_beam_counters* counters, wt_floor limit, wt_beam_arguments args) {
  local wt_shared shared;
  const wt_results out = {{reflectances, materials_of, limit}, table, quarters, next, waiting, counters, args};
  const uint count = min(counters->waiting[1 - args.round % 2], args.waiting_capacity);
  for (uint i = get_group_id(0); i < count; i += get_num_groups(0)) {
    const uint candidate = pieces[i].candidate, aperture = chunks[candidate / WT_CHUNK].aperture;
    const wt_world world = {facets, corners, surfaces, apertures + aperture, chunks, candidates, args.walls};
    look_at(&world, lit_spaces + (aperture - args.first), candidate, pieces + i, &out, &shared);
  }
}
