// SPDX-License-Identifier: Apache-2.0
// tile_edges: candidates of ways from an end over one edge to a tile, from the prefixes of all ends that see the edge,
// for tiles that an end of a wanted link sees by mirrors or directly. place_tiles finds how strongly tiles are seen,
// and tile_balls and group_balls put balls around them, which tile_edges leaves out as a whole where they are not
// reached. tile_rows makes open rows of the ways that wedge_solve has solved.
#include "lib/tile.clh"
#include "lib/tile_balls.clh"
#pragma OPENCL FP_CONTRACT OFF

// A work-item takes one tile. keys, prefixes: of point_prefixes, sorted; keys from `hidden` on are of hidden ones.
// powers: see point_join, or null. Writes the tile's place (its instance, as that of an end, is none), the first prefix
// that sees it, and bounds of the gains of paths whose other way is 1 m long, over prefixes of ends that send and of
// those that receive: both 0 where no end sees the tile.
kernel void place_tiles(const global uint* keys, const global wt_point_prefix* prefixes,
                        const global uint* receiver_of_end, const global double* powers, const global uint4* tiles_of,
                        const global uint* surface_of_tile, const global double* centres,
                        const global wt_exact_surface* surfaces, const global wt_exact_instance* instances,
                        global double4* places, global uint* firsts, global float2* strengths, uint tile_count,
                        uint point_count, uint transmitter_count, uint hidden) {
  const uint tile = get_global_id(0);
  if (tile >= tile_count) return;
  const uint surface = surface_of_tile[tile], first = wt_lower_bound(keys, point_count, wt_point_key(tile, 0));
  const uint4 tiles = tiles_of[surface];
  const double3 p = wt_tile_centre(centres, instances, surfaces[surface].instance, tiles.y + tile - tiles.x);
  double sent = 0.0, heard = 0.0;
  for (uint j = first; j < point_count && keys[j] < hidden && wt_tile_of_key(keys[j]) == tile; ++j) {
    const uint end = prefixes[j].end;
    if (end < transmitter_count) sent = fmax(sent, prefixes[j].spread);
    if (receiver_of_end[end] != WT_NONE) heard = fmax(heard, prefixes[j].spread);
  }
  const double power = powers ? 1.0001 * powers[tile] : 1.0;
  places[tile] = (double4)(p, -1.0);
  firsts[tile] = first;
  strengths[tile] = (float2)((float)(power * sent), (float)(power * heard));
}

// A work-item takes WT_TILE_BALL tiles of `order`, of which WT_NONE is none.
kernel void tile_balls(const global uint* order, const global double4* places, const global float2* strengths,
                       global wt_tile_ball* balls, uint count) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  double3 low = (double3)(INFINITY, INFINITY, INFINITY), high = -low;
  float2 most = (float2)(0.0f, 0.0f);
  for (uint k = i * WT_TILE_BALL; k < (i + 1) * WT_TILE_BALL; ++k) {
    if (order[k] == WT_NONE || !(strengths[order[k]].x + strengths[order[k]].y > 0.0f)) continue;
    low = fmin(low, places[order[k]].xyz);
    high = fmax(high, places[order[k]].xyz);
    most = fmax(most, strengths[order[k]]);
  }
  const int any = most.x + most.y > 0.0f;
  const double3 middle = any ? 0.5 * (low + high) : (double3)(0.0, 0.0, 0.0), across = any ? high - low : middle;
  balls[i].middle[0] = (float)middle.x;
  balls[i].middle[1] = (float)middle.y;
  balls[i].middle[2] = (float)middle.z;
  balls[i].radius = (float)(0.50001 * sqrt(wt_dot(across, across)));
  balls[i].sent = most.x;
  balls[i].heard = most.y;
}

// A work-item takes WT_TILE_BALL balls, of `balls`.
kernel void group_balls(const global wt_tile_ball* balls, global wt_tile_ball* groups, uint count, uint ball_count) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  float3 low = (float3)(INFINITY, INFINITY, INFINITY), high = -low;
  float sent = 0.0f, heard = 0.0f;
  for (uint k = i * WT_TILE_BALL; k < min((i + 1) * WT_TILE_BALL, ball_count); ++k) {
    if (!(balls[k].sent + balls[k].heard > 0.0f)) continue;
    const float3 middle = (float3)(balls[k].middle[0], balls[k].middle[1], balls[k].middle[2]);
    low = fmin(low, middle - balls[k].radius);
    high = fmax(high, middle + balls[k].radius);
    sent = fmax(sent, balls[k].sent);
    heard = fmax(heard, balls[k].heard);
  }
  const int any = sent + heard > 0.0f;
  const float3 middle = any ? 0.5f * (low + high) : (float3)(0.0f, 0.0f, 0.0f), across = any ? high - low : middle;
  groups[i].middle[0] = middle.x;
  groups[i].middle[1] = middle.y;
  groups[i].middle[2] = middle.z;
  groups[i].radius = 0.5001f * sqrt(across.x * across.x + across.y * across.y + across.z * across.z);
  groups[i].sent = sent;
  groups[i].heard = heard;
}

// The strength that matters for an end that sends or receives or does both.
inline float strength_for(uint roles, float sent, float heard) {
  return fmax(roles & 1u ? heard : 0.0f, roles & 2u ? sent : 0.0f);
}

// Is a path wanted, from either end to the other?
inline int is_wanted(uint a, uint b, const global uint* receiver_of_end, const global ushort* links,
                     const wt_tile_edges_arguments* args) {
  const uint from_a = receiver_of_end[b], from_b = receiver_of_end[a];
  return (a < args->transmitter_count && from_a != WT_NONE &&
          (links[(size_t)a * args->groups + from_a / 16] >> from_a % 16 & 1)) ||
         (b < args->transmitter_count && from_b != WT_NONE &&
          (links[(size_t)b * args->groups + from_b / 16] >> from_b % 16 & 1));
}

// Does a prefix that sees the tile make a path with a way over an edge, and is it not surely too weak? power: a bound
// of the tile and of that way together; first: the tile's first prefix.
inline int has_partner(const global wt_wedge_prefix* a, uint tile, uint first, double power, const global uint* keys,
                       const global wt_point_prefix* points, const global uint* receiver_of_end,
                       const global ushort* links, const wt_tile_edges_arguments* args) {
  for (uint j = first; j < args->places && wt_tile_of_key(keys[j]) == tile; ++j)
    if (a->depth + 1 + points[j].depth <= args->max_depth &&
        (args->floor == 0.0 || power * points[j].spread >= args->floor) &&
        is_wanted(a->end, points[j].end, receiver_of_end, links, args))
      return 1;
  return 0;
}

// `lanes` work-items take each prefix of a block, in the order of their wedges, and share the groups of balls. The
// receiver of a candidate is the number of its tile. point_keys, points: as for place_tiles, without hidden ones.
kernel void tile_edges(const global uint* keys, const global wt_wedge_prefix* prefixes, const global uint* point_keys,
                       const global wt_point_prefix* points, const global uint* receiver_of_end,
                       const global ushort* links, const global wt_wedge* wedges, const global wt_surface* surfaces,
                       const global double* powers, const global uint* order, const global double4* places,
                       const global uint* firsts, const global float2* strengths, const global wt_tile_ball* balls,
                       const global wt_tile_ball* groups, global wt_wedge_candidate* out, global wt_counters* counters,
                       wt_tile_edges_arguments args) {
  const uint i = args.first + get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.end || keys[i] == WT_NONE) return;
  const global wt_wedge_prefix* a = prefixes + i;
  const uint wedge = wt_wedge_of(keys[i]), group_count = (args.balls + WT_TILE_BALL - 1) / WT_TILE_BALL;
  const global wt_wedge* w = wedges + wedge;
  // A corner would need all of its reflections beside it.
  if (a->depth >= args.interactions || w->exterior < M_PI) return;
  const uint roles = (a->end < args.transmitter_count ? 1u : 0u) | (receiver_of_end[a->end] != WT_NONE ? 2u : 0u);
  const wt_bent_wave wave = wt_bent_wave_of(a, w);
  const float wave_m = args.floor > 0.0 ? (float)args.wave_m : 0.0f, floor = 0.999f * (float)args.floor;
  wt_found_candidates batch;
  batch.count = 0;
  for (uint g = lane; g < group_count; g += args.lanes) {
    const float of_group = strength_for(roles, groups[g].sent, groups[g].heard);
    const float middle_of_group[3] = {groups[g].middle[0], groups[g].middle[1], groups[g].middle[2]};
    if (of_group == 0.0f || !(of_group * wt_most_to_ball(&wave, middle_of_group, groups[g].radius, wave_m) > floor))
      continue;
    for (uint b = g * WT_TILE_BALL; b < min((g + 1) * WT_TILE_BALL, args.balls); ++b) {
      const float of_ball = strength_for(roles, balls[b].sent, balls[b].heard);
      const float middle[3] = {balls[b].middle[0], balls[b].middle[1], balls[b].middle[2]};
      if (of_ball == 0.0f || !(of_ball * wt_most_to_ball(&wave, middle, balls[b].radius, wave_m) > floor)) continue;
      for (uint k = b * WT_TILE_BALL; k < (b + 1) * WT_TILE_BALL; ++k) {
        const uint tile = order[k];
        if (tile == WT_NONE || !(strength_for(roles, strengths[tile].x, strengths[tile].y) > 0.0f)) continue;
        const double3 at = wt_in_wedge(w, places[tile].xyz);
        if (!wt_in_sector(w, at, WT_ON_SURFACE_M)) continue;
        const float place[3] = {(float)places[tile].x, (float)places[tile].y, (float)places[tile].z};
        const wt_edge_onlooker to = {(float3)(place[0], place[1], place[2]), (float)at.x, (float)wt_from_edge(at), 0,
                                     WT_NONE};
        if (!wt_may_cross(&wave.from, &to, w, surfaces, args.end_detour_m, 1, 1)) continue;
        const float most = wt_most_to_ball(&wave, place, 0.0f, wave_m);
        if (!(most > 0.0f)) continue;
        const double power = 1.001 * (double)most * (powers ? powers[tile] : 1.0);
        if (has_partner(a, tile, firsts[tile], power, point_keys, points, receiver_of_end, links, &args))
          wt_emit_candidate(a->node, WT_ROOT, wedge, WT_NONE, tile, a->quarters, &batch, out, args.capacity, counters);
      }
    }
  }
  wt_list_candidates(&batch, out, args.capacity, counters);
}

// A work-item takes one row of wedge_solve, whose receiver is a tile: the tile becomes its last vertex. A row whose
// edge does not see the tile from one of its sides is marked as obstructed.
kernel void tile_rows(const global double4* places, const global uint* surface_of_tile,
                      const global wt_exact_surface* surfaces, global wt_solved* solved, global double* vertices,
                      global uint* sequences, uint count, uint max_depth) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const uint tile = solved[i].receiver, depth = solved[i].depth;
  const size_t at = (size_t)i * max_depth + depth;
  const double above = wt_above(surfaces + surface_of_tile[tile], vload3(at - 1, vertices));
  vstore3(places[tile].xyz, at, vertices);
  sequences[at] = WT_STEP_SCATTERING | tile;
  solved[i].receiver = 0;
  solved[i].depth = depth + 1;
  if (!(fabs(above) > WT_ON_SURFACE_M)) solved[i].blocked = 1;
}
