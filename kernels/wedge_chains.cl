// wedge_chains: paths over several edges, found by the string of each link. For a link only a few chains of edges are
// tried, those that a string between its ends touches when it is pulled tight. They are solved at once, in double: no
// pairs of edges are listed, and no ray is needed. It produces rows as wedge_solve does; legs are not tested here.
#include "lib/string_sets.clh"

// The string is pulled at most this often, each time over the way that was found. After WT_SLIPS_AFTER pulls a way that
// still leaves an edge slips off it.
#define WT_PULLS 12
#define WT_SLIPS_AFTER 3

// Adds the upright edges of the chain, at which the curtain bends, to the edges that the string over it touches.
// Returns 0 if there are more than `most` edges.
inline int keep_uprights(const global wt_wedge* wedges, const wt_edge_chain* chain, const wt_curtain* curtain,
                         uint most, wt_edge_chain* next, double* along) {
  for (uint i = 0; i < chain->count; ++i) {
    if (!wt_is_upright(wedges + chain->wedges[i])) continue;
    if (next->count == most) return 0;
    wt_insert_edge(next, along, chain->wedges[i], chain->places[i], curtain->along[i + 1]);
  }
  return 1;
}

// A way that leaves an edge of a roof slips off the corner of the house there: the upright edge below replaces that
// edge and its neighbours that meet it in that corner. Returns the number of edges that the way leaves, or WT_NONE
// where there is no upright edge.
inline uint slip_off(const wt_edge_map* map, wt_edge_chain* chain) {
  uint kept = 0, left = 0, corner = WT_NONE;  // corner: the upright edge that the way has just gone around
  for (uint i = 0; i < chain->count; ++i) {
    uint wedge = chain->wedges[i];
    double place = chain->places[i];
    const global uint* ends = map->uprights + 2 * wedge;
    if (corner != WT_NONE && (wedge == corner || ends[0] == corner || ends[1] == corner)) continue;
    corner = WT_NONE;
    if (!wt_within_edge(map->wedges + wedge, place)) {
      ++left;
      wedge = corner = ends[place > 0.0];
      if (wedge == WT_NONE) return WT_NONE;
      place = 0.5 * map->wedges[wedge].length;
      while (kept > 0 && (chain->wedges[kept - 1] == wedge || map->uprights[2 * chain->wedges[kept - 1]] == wedge ||
                          map->uprights[2 * chain->wedges[kept - 1] + 1] == wedge))
        --kept;
    }
    chain->wedges[kept] = wedge;
    chain->places[kept++] = place;
  }
  chain->count = kept;
  return left;
}

// A way that runs through the corner in which two edges of a roof meet goes around the upright edge there instead.
// Returns whether there was such a corner.
inline int round_corner(const wt_edge_map* map, wt_edge_chain* chain, double3 a, double3 b) {
  for (uint i = 0; i + 1 < chain->count; ++i) {
    const double3 way =
        wt_point_of_chain(map->wedges, chain, i + 2, a, b) - wt_point_of_chain(map->wedges, chain, i + 1, a, b);
    if (wt_dot(way, way) > WT_BESIDE_UPRIGHT_M * WT_BESIDE_UPRIGHT_M) continue;
    for (uint ends = 0; ends < 4; ++ends) {
      const uint upright = map->uprights[2 * chain->wedges[i] + (ends & 1)];
      if (upright == WT_NONE || upright != map->uprights[2 * chain->wedges[i + 1] + ends / 2]) continue;
      if (upright == chain->wedges[i] || upright == chain->wedges[i + 1]) continue;
      chain->wedges[i] = upright;
      chain->places[i] = 0.5 * map->wedges[upright].length;
      --chain->count;
      for (uint k = i + 1; k < chain->count; ++k) {
        chain->wedges[k] = chain->wedges[k + 1];
        chain->places[k] = chain->places[k + 1];
      }
      return 1;
    }
  }
  return 0;
}

inline int is_same_chain(const wt_edge_chain* a, const wt_edge_chain* b) {
  int same = a->count == b->count;
  for (uint i = 0; same && i < a->count; ++i) same = a->wedges[i] == b->wedges[i];
  return same;
}

// Pulls the string over the roofs, in the vertical plane through both ends. Its way is the shortest over its edges,
// which leaves that plane where edges are not square to it. Other edges may stand there, so the string is pulled again
// over the line of the way in plan, until it touches the same edges. Where it slips off the corner of a roof it goes
// around the upright edge there. aside: the plane of the first pull is bent in its middle, by this part of the
// distance. Returns 0 if this does not end, or there are no edges or too many.
inline int over_roofs(const wt_edge_map* map, const wt_edge_map_arguments* grid, double3 a, double3 b, double aside,
                      uint most, wt_edge_chain* chain) {
  wt_curtain curtain;
  wt_edge_chain next;
  double along[WT_MOST_EDGES];
  next.count = 0;
  for (int pull = 0; pull < WT_PULLS; ++pull) {
    if (!wt_hang_curtain(map->wedges, &next, a, b, &curtain)) return 0;
    if (pull == 0 && aside != 0.0) wt_bend_aside(aside, &curtain);
    *chain = next;
    if (!wt_pull_string(map, grid, &curtain, a.z, b.z, most, &next, along)) return 0;
    if (!keep_uprights(map->wedges, chain, &curtain, most, &next, along) || next.count == 0) return 0;
    const int same = is_same_chain(&next, chain);
    if (same) next = *chain;
    int settled = same || wt_shortest_over_chain(map->wedges, &next, a, b);
    if (!same && round_corner(map, &next, a, b)) settled = wt_shortest_over_chain(map->wedges, &next, a, b);
    if (!settled) return 0;
    if (!same && pull < WT_SLIPS_AFTER) continue;
    wt_edge_chain slipped = next;
    const uint left = slip_off(map, &slipped);
    if (same && (left == 0 || left == WT_NONE)) return left == 0;
    if (left == 0 || left == WT_NONE) continue;
    next = slipped;
    if (!wt_shortest_over_chain(map->wedges, &next, a, b)) return 0;
  }
  return 0;
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
  const double aside = (string % 2 == 0 ? 0.1 : -0.1) * ((string + 1) / 2);
  chain.count = 0;
  if (!over_roofs(&map, &args.map, a.xyz, b.xyz, aside, args.most_edges, &chain) && (chain.count > 0 || string > 0))
    return;
  wt_curtain curtain;
  wt_near_edges near;
  near.count = 0;
  near.wavelength_m = args.wavelength_m;
  if (wt_hang_curtain(wedges, &chain, a.xyz, b.xyz, &curtain)) {
    for (uint i = 0; i <= chain.count + 1; ++i) near.heights[i] = wt_point_of_chain(wedges, &chain, i, a.xyz, b.xyz).z;
    wt_find_near_edges(&map, &args.map, &curtain, &near);
  }
  const uint always = wt_edges_of_planes(wedges, &chain, &near);
  for (uint set = 0; set < 1u << near.count; ++set)
    if ((string == 0 ? (set & always) == always : set == always) &&
        wt_widen(&chain, &curtain, &near, set, args.most_edges, &wider) && wider.count > 0 &&
        wt_solve_set(wedges, &wider, turned, a.xyz, b.xyz) && wt_is_free_chain(wedges, &wider, a.xyz, b.xyz))
      wt_enter_chain(wedges, &wider, turned, transmitter, receiver, args.max_depth, args.capacity, solved, vertices,
                     sequences, counters);
}
