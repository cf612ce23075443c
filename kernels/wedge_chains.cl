// wedge_chains: paths over several edges, by the string of each link. Of a link only a few chains of edges are tried,
// those that a string between its ends touches when it is pulled tight, and these are solved at once, in double: no
// pairs of edges are listed, and no ray is needed. Produces rows as wedge_solve does; legs are not tested here.
#include "lib/curtain.clh"

// So often the string is pulled again, over the way that was found.
#define WT_PULLS 8

// The string over the roofs, in the vertical plane through both ends. Its way is the shortest over its edges, which
// runs beside that plane where edges are not square to it; there other edges may stand, so the string is pulled again
// over the line of the way in plan, until it touches the same edges. 0 where it does not, or has no edges or too many.
inline int over_roofs(const wt_edge_map* map, const wt_edge_map_arguments* grid, double3 a, double3 b, uint most,
                      wt_edge_chain* chain) {
  wt_curtain curtain;
  wt_edge_chain next;
  next.count = 0;
  for (int pull = 0; pull < WT_PULLS; ++pull) {
    if (!wt_hang_curtain(map->wedges, &next, a, b, &curtain)) return 0;
    *chain = next;
    if (!wt_pull_string(map, grid, &curtain, a.z, b.z, most, &next) || next.count == 0) return 0;
    int same = pull > 0 && next.count == chain->count;
    for (uint i = 0; same && i < next.count; ++i) same = next.wedges[i] == chain->wedges[i];
    if (same) return 1;
    if (!wt_shortest_over_chain(map->wedges, &next, a, b)) return 0;
  }
  return 0;
}

// One pair of a transmitter and a receiver per work-item. Both ways of a link find the same bits: the string is pulled
// from the end of the lower coordinates. first, listed, radii: see wt_edge_map.
kernel void roof_chains(const global wt_wedge* wedges, const global uint* first, const global uint* listed,
                        const global double* radii, const global wt_exact_instance* instances,
                        const global double4* transmitters, const global double4* receivers, const global ushort* links,
                        global wt_solved* solved, global double* vertices, global uint* sequences,
                        global wt_counters* counters, wt_wedge_chains_arguments args) {
  const uint transmitter = get_global_id(0) / args.receiver_capacity,
             receiver = get_global_id(0) % args.receiver_capacity;
  if (transmitter >= args.transmitter_count) return;
  const uint groups = args.receiver_capacity / 16;
  if (!(links[(size_t)transmitter * groups + receiver / 16] >> receiver % 16 & 1)) return;
  const double4 from = transmitters[transmitter], to = receivers[receiver];
  const int turned = to.x < from.x || (to.x == from.x && (to.y < from.y || (to.y == from.y && to.z < from.z)));
  const double4 a = turned ? to : from, b = turned ? from : to;
  const wt_edge_map map = {wedges, first, listed, radii, instances, {wt_end_instance(a), wt_end_instance(b)}};
  wt_edge_chain chain;
  if (over_roofs(&map, &args.map, a.xyz, b.xyz, args.most_edges, &chain) &&
      wt_is_free_chain(wedges, &chain, a.xyz, b.xyz))
    wt_enter_chain(wedges, &chain, turned, transmitter, receiver, args.max_depth, args.capacity, solved, vertices,
                   sequences, counters);
}
