// SPDX-License-Identifier: Apache-2.0
// wedge_chains: paths over several edges, by the strings of each link. For a link only a few chains of edges are tried,
// those that strings between its ends touch when they are pulled tight, and these are solved at once, in double: no
// pairs of edges are listed, and no ray is needed. Produces rows as wedge_solve does; legs are not tested here.
#include "lib/around.clh"
#include "lib/settle.clh"
#include "lib/string_sets.clh"

// Strings from WT_STRINGS_AROUND on pass beside roofs, two of them, left and right, for each roof that is tried; those
// from WT_STRINGS_WIDE on make a wider bow. String `string` begins with the edges in the chain, none or upright ones,
// and in a curtain bent by `aside`, see wt_settle_string. 0 where there is none.
inline int begin_string(const wt_edge_map* map, const wt_edge_map_arguments* grid, double3 a, double3 b, uint string,
                        uint most, wt_edge_chain* chain, double* aside) {
  const double left = string % 2 == 0 ? 1.0 : -1.0;
  chain->count = 0;
  *aside = 0.0;
  if (string < WT_STRINGS_AROUND) {
    *aside = left * 0.1 * ((string + 1) / 2);
    return 1;
  }
  wt_curtain straight;
  wt_edge_chain over;
  double along[WT_MOST_EDGES];
  if (!wt_hang_curtain(map->wedges, chain, a, b, &straight)) return 0;
  if (string >= WT_STRINGS_WIDE) {
    *aside = left * 0.1 * ((string + 1 - WT_STRINGS_WIDE + WT_STRINGS_AROUND) / 2);
    // wedge_pairs has those of up to two edges.
    return most > 2 && !wt_pull_string(map, grid, &straight, a.z, b.z, most, &over, along);
  }
  wt_pull_string(map, grid, &straight, a.z, b.z, WT_MOST_EDGES, &over, along);
  uint roof = WT_NONE;
  if (string >= WT_STRINGS_AROUND + 2) {
    const uint which = (string - WT_STRINGS_AROUND) / 2 - 1;
    if (which >= over.count) return 0;
    roof = over.wedges[which];
    for (uint i = 0; i < which; ++i)
      if (wt_share_roof(map->wedges + roof, map->wedges + over.wedges[i])) return 0;
  }
  return over.count > 0 && wt_go_around(map, grid, a, b, roof, left, most, &straight, &over, along, chain);
}

// WT_STRINGS work-items for each pair of a transmitter and a receiver: a string that slips off the corners of a roof in
// one plane may hold in the next. Most strings end at the same edges, and are one path. Both directions of a link find
// the same bits: the string is pulled from the end with the lower coordinates. first, listed, radii, uprights: see
// wt_edge_map.
kernel void roof_chains(const global wt_wedge* wedges, const global uint* first, const global uint* listed,
                        const global double* radii, const global uint* uprights,
                        const global wt_exact_instance* instances, const global double4* transmitters,
                        const global double4* receivers, const global ushort* links, global wt_solved* solved,
                        global double* vertices, global uint* sequences, global wt_counters* counters,
                        wt_wedge_chains_arguments args) {
  const uint pair = get_global_id(0) / WT_STRINGS, string = get_global_id(0) % WT_STRINGS;
  const uint transmitter = pair / args.receiver_capacity, receiver = pair % args.receiver_capacity;
  if (transmitter >= args.transmitter_count) return;
  const uint groups = args.receiver_capacity / 16;
  if (!(links[(size_t)transmitter * groups + receiver / 16] >> receiver % 16 & 1)) return;
  const double4 from = transmitters[transmitter], to = receivers[receiver];
  const int turned = to.x < from.x || (to.x == from.x && (to.y < from.y || (to.y == from.y && to.z < from.z)));
  const double4 a = turned ? to : from, b = turned ? from : to;
  const wt_edge_map map = {wedges, first, listed, radii, uprights, instances, {wt_end_instance(a), wt_end_instance(b)}};
  wt_edge_chain chain, wider;
  double aside;
  if (!begin_string(&map, &args.map, a.xyz, b.xyz, string, args.most_edges, &chain, &aside)) return;
  const int settled = wt_settle_string(&map, &args.map, a.xyz, b.xyz, aside, &chain);
  if ((!settled && (chain.count > 0 || string > 0)) || chain.count > args.most_edges) return;
  wt_curtain curtain;
  wt_near_edges near;
  near.count = 0;
  near.wavelength_m = args.wavelength_m;
  if (wt_hang_curtain(wedges, &chain, a.xyz, b.xyz, &curtain)) {
    for (uint i = 0; i <= chain.count + 1; ++i) near.heights[i] = wt_point_of_chain(wedges, &chain, i, a.xyz, b.xyz).z;
    wt_find_near_edges(&map, &args.map, &curtain, &near);
  }
  const uint planes = wt_edges_of_planes(wedges, &chain, &near);
  // Edges of planes belong to all sets, or, if they are too many, to none: a path with some of them is better than
  // none.
  const uint always = chain.count + popcount(planes) > args.most_edges ? 0 : planes;
  for (uint set = 0; set < 1u << near.count; ++set)
    if ((string == 0 ? (set & planes) == always : set == always) &&
        wt_widen(&chain, &curtain, &near, set, args.most_edges, &wider) && wider.count > 0 &&
        wt_solve_set(wedges, &wider, turned, a.xyz, b.xyz) && wt_is_free_chain(wedges, &wider, a.xyz, b.xyz))
      wt_enter_chain(wedges, &wider, turned, transmitter, receiver, args.max_depth, args.capacity, solved, vertices,
                     sequences, counters);
}
