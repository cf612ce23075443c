// SPDX-License-Identifier: Apache-2.0
// point_prefixes: lists the points (tiles of rough surfaces) that ends see by chains of mirrors, with the points of the
// reflections. A node of the trie is a prefix and the surface that its rays met next, so it may see the tiles of that
// surface. onlookers lists these; point_prefixes solves them exactly, as rows that end at their last vertex, the tile.
// After the legs of the rows have been tested, point_keys gives each row its sort key, and place_points puts what the
// join needs into the order of the sorted keys.
#include "lib/count.clh"
#include "lib/seen_tiles.clh"
#include "lib/tile.clh"
#include "lib/weak_bends.clh"
#pragma OPENCL FP_CONTRACT OFF

// May a point of the block, a box of two corners, be seen from the image in the mirror? If all corners of the box are
// behind the mirror, the lines to them enclose those to all of its points, and so do their crossings of the plane.
inline int may_show_block(const global wt_exact_surface* mirror, const global wt_surface* box, double3 image,
                          const global double* block) {
  const double a = wt_above(mirror, image), size = wt_rounding(image);
  if (!(fabs(a) > size)) return 1;
  double3 low = (double3)(INFINITY, INFINITY, INFINITY), high = -low;
  for (uint corner = 0; corner < 8; ++corner) {
    const double3 p = (double3)(block[corner & 1 ? 3 : 0], block[corner & 2 ? 4 : 1], block[corner & 4 ? 5 : 2]);
    const double b = wt_above(mirror, p);
    if (!((a > 0.0 ? b : -b) < -WT_ON_SURFACE_M)) return 1;
    const double3 at = image + a / (a - b) * (p - image);
    low = fmin(low, at);
    high = fmax(high, at);
  }
  const double margin = 1e-3 + 1e3 * size;
  return high.x >= box->lower[0] - margin && low.x <= box->upper[0] + margin && high.y >= box->lower[1] - margin &&
         low.y <= box->upper[1] + margin && high.z >= box->lower[2] - margin && low.z <= box->upper[2] + margin;
}

// args.lanes work-items take each node, and share its blocks of tiles. ends: all ends that launch rays; those of root r
// are first_ends[r] .. first_ends[r + 1]. Appends (node, end, first tile, tiles) for each block of the tiles from
// args.first_tile to args.end_tile - 1 that the last mirror may show; *count is their number. blocks: see TileBuffers.
kernel void onlookers(const global ulong* table, const global uint* nodes, const global double4* ends,
                      const global uint* first_ends, const global wt_exact_surface* surfaces,
                      const global wt_surface* boxes, const global uint4* tiles_of, const global double* blocks,
                      global uint4* out, global uint* count, const global wt_counters* counters,
                      wt_onlookers_arguments args) {
  const uint i = get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= wt_node_count(counters, args.node_count) || (nodes[i] & WT_ROOT)) return;
  const uint surface = wt_trie_surface(table[nodes[i]]);
  const uint4 tiles = tiles_of[surface];
  const uint first = max(tiles.x, args.first_tile), last = min(tiles.x + tiles.z, args.end_tile);
  if (tiles.z == 0 || first >= last) return;
  uint chain[WT_MAX_DEPTH], root;
  const uint depth = wt_chain(table, nodes[i], chain, &root) - 1;
  if (depth > args.reflections) return;
  for (uint end = first_ends[root]; end < first_ends[root + 1]; ++end) {
    if (wt_carries(surfaces + chain[0], ends[end])) continue;
    double3 image = ends[end].xyz;
    for (uint k = 0; k < depth; ++k) image = wt_reflected(surfaces + chain[k], image);
    // The surface must have a side that faces the image; an absent vehicle's has none.
    if (!(fabs(wt_above(surfaces + surface, image)) > wt_rounding(image))) continue;
    for (uint block = (first - tiles.x) / WT_TILE_BLOCK + lane; tiles.x + block * WT_TILE_BLOCK < last;
         block += args.lanes) {
      const uint begin = tiles.x + block * WT_TILE_BLOCK;
      const uint tile = max(first, begin), next = min(begin + WT_TILE_BLOCK, last);
      if (depth > 0 && tiles.w != WT_NONE &&
          !may_show_block(surfaces + chain[depth - 1], boxes + chain[depth - 1], image,
                          blocks + 6 * (size_t)(tiles.w + block)))
        continue;
      const uint slot = wt_take_places(count, 1);
      if (slot < args.capacity) out[slot] = (uint4)(nodes[i], end, tile, next - tile);
    }
  }
}

// A work-item takes rows_per_item pairs of an entry of onlookers and one of its tiles. first_row: for each entry its
// first pair, and row_count after the last; floors: for each tile, null without a floor: ways that are surely too long
// for it are left out. Appends a row for each tile that is seen: wt_solved::transmitter is the
// end, and the last vertex is the tile. *count is the number of rows.
kernel void point_prefixes(const global ulong* table, const global uint* quarters, const global double4* ends,
                           const global uint* receiver_of_end, const global ushort* links,
                           const global wt_point_floor* floors, const global uint4* entries,
                           const global uint* first_row, const global wt_exact_surface* surfaces,
                           const global wt_surface* boxes, const global double* triangles,
                           const global wt_exact_instance* instances, const global uint4* tiles_of,
                           const global double* centres, global wt_solved* solved, global double* vertices,
                           global uint* sequences, global uint* count, wt_point_prefixes_arguments args) {
  const ulong begin = (ulong)get_global_id(0) * args.rows_per_item;
  if (begin >= args.row_count) return;
  const uint end = (uint)min(begin + args.rows_per_item, (ulong)args.row_count);
  uint entry = wt_entry_at(first_row, args.entry_count, begin);
  wt_seen_by by;
  wt_see_by(table, surfaces, ends[entries[entry].y], entries[entry].x, &by);
  by.roles = wt_roles_of(entries[entry].y, args.transmitter_count, receiver_of_end, links, args.groups);
  double3 points[WT_MAX_DEPTH];
  for (uint row = (uint)begin; row < end; ++row) {
    if (row == first_row[entry + 1]) {  // no entry is empty
      ++entry;
      wt_see_by(table, surfaces, ends[entries[entry].y], entries[entry].x, &by);
      by.roles = wt_roles_of(entries[entry].y, args.transmitter_count, receiver_of_end, links, args.groups);
    }
    const uint tile = entries[entry].z + row - first_row[entry];
    const uint4 tiles = tiles_of[by.surface];
    const double3 centre = wt_tile_centre(centres, instances, surfaces[by.surface].instance, tiles.y + tile - tiles.x);
    const double3 way = centre - by.images[by.depth];
    if (floors && wt_is_too_long(floors + tile, entries[entry].y, &by.roles, wt_dot(way, way))) continue;
    if (!wt_sees(surfaces, boxes, triangles, instances, &by, centre, points)) continue;
    const uint slot = wt_take_places(count, 1);
    if (slot >= args.capacity) continue;
    solved[slot].transmitter = entries[entry].y;
    solved[slot].receiver = 0;
    solved[slot].depth = by.depth + 1;
    solved[slot].blocked = 0;
    solved[slot].node = WT_NONE;
    solved[slot].quarters = wt_found_by(quarters, entries[entry].x);
    const size_t at = (size_t)slot * args.max_depth;
    for (uint k = 0; k < by.depth; ++k) {
      vstore3(points[k], at + k, vertices);
      sequences[at + k] = by.chain[k];
    }
    vstore3(centre, at + by.depth, vertices);
    sequences[at + by.depth] = WT_STEP_SCATTERING | tile;
  }
}

// The vertex before the tile, or the end.
inline double3 before_tile(const global wt_solved* row, const global double4* ends, const global double* v) {
  return row->depth > 1 ? vload3((size_t)(row->depth - 2), v) : ends[row->transmitter].xyz;
}

// A work-item takes one row. Its key is wt_point_key of its tile and the side that it sees; hidden: the key of a row
// whose legs are obstructed, larger than all others.
kernel void point_keys(const global wt_solved* solved, const global double* vertices, const global uint* sequences,
                       const global double4* ends, const global wt_exact_surface* surfaces,
                       const global uint* surface_of_tile, global uint* keys, uint count, uint max_depth, uint hidden) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const size_t at = (size_t)i * max_depth;
  const uint tile = sequences[at + solved[i].depth - 1] & ~WT_STEP_KIND;
  const double above = wt_above(surfaces + surface_of_tile[tile], before_tile(solved + i, ends, vertices + 3 * at));
  keys[i] = solved[i].blocked ? hidden : wt_point_key(tile, above > 0.0);
}

// A work-item takes one sorted key: what the join needs of its row goes to the place of the key. Rows that are hidden
// have the last keys, and nothing reads them. wedges: for bounds of waves over an edge next to the point, or null;
// wave_m: see wt_tile_edges_arguments.
kernel void place_points(const global uint* keys, const global uint* order, const global wt_solved* solved,
                         const global double* vertices, const global uint* sequences, const global double4* ends,
                         const global wt_wedge* wedges, global wt_point_prefix* sorted, uint count, uint max_depth,
                         uint hidden, double wavelength_m, double wave_m) {
  const uint i = get_global_id(0);
  if (i >= count || keys[i] >= hidden) return;
  const uint row = order[i], depth = solved[row].depth;
  double length_m = 0.0;
  uint transmissions = 0, diffractions = 0, wedge = 0;
  double3 from = ends[solved[row].transmitter].xyz, image = from, edge = from;
  for (uint k = 0; k < depth; ++k) {
    const size_t at = (size_t)row * max_depth + k;
    const double3 to = vload3(at, vertices), along = to - from;
    const double leg_m = sqrt(wt_dot(along, along));
    length_m += leg_m;
    transmissions += (sequences[at] & WT_STEP_KIND) == WT_STEP_TRANSMISSION;
    if ((sequences[at] & WT_STEP_KIND) == WT_STEP_DIFFRACTION) {
      ++diffractions;
      wedge = sequences[at] & ~WT_STEP_KIND;
      image = to - length_m / leg_m * along;
      edge = to;
    }
    from = to;
  }
  sorted[i].spread = (diffractions > 0 ? WT_MOST_OF_EDGE : 1.0) / (length_m * length_m);
  if (wedges && diffractions > 0 && wedges[wedge].free_ends == 0u)
    sorted[i].spread =
        fmin(sorted[i].spread, wave_m * wt_most_over_one(wedges + wedge, image, from, edge, wavelength_m));
  sorted[i].row = row;
  sorted[i].end = solved[row].transmitter;
  sorted[i].depth = depth;
  sorted[i].transmissions = transmissions;
  sorted[i].quarters = solved[row].quarters;
  sorted[i].diffractions = diffractions;
}
