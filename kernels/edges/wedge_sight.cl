// SPDX-License-Identifier: Apache-2.0
// wedge_sight: finds the pieces of its edge that a prefix may see. Rays only say that a prefix sees a face. This pass
// decides, without losing any path, whether the edge can be seen in the mirrors and past other surfaces.
#include "lib/bend_bound.clh"
#include "lib/join.clh"
#include "lib/shown_part.clh"
#include "wavetracer/device/arguments.h"

// The images of prefixes are float32.
inline double margin_of(double3 image) { return 1e-3 + 4e-7 * (fabs(image.x) + fabs(image.y) + fabs(image.z)); }

// Do all lines from the image to the segment miss the mirror, because of one of its sides?
inline int misses(const wt_sight* sight, uint mirror, const wt_lines* l) {
  if (mirror >= sight->static_surfaces) return 0;
  for (uint k = sight->first_sides[mirror]; k < sight->first_sides[mirror + 1]; ++k)
    if (wt_above_side(sight->sides, k, l->a0) < -l->margin_m && wt_above_side(sight->sides, k, l->a1) < -l->margin_m)
      return 1;
  return 0;
}

// May a point between b0 and b1 be seen from the image, in the mirrors of the chain? Each leg is tested on its own, the
// last one first: its lines begin on its mirror, where the leg before ends.
inline int may_see(const wt_sight* sight, const uint* chain, uint depth, double3 image, double3 b0, double3 b1,
                   wt_hiders* hiders) {
  const double margin_m = margin_of(image);
  wt_lines l = {image, image, b0, b1, 1, margin_m};
  for (uint k = depth;; --k) {
    if (k > 0) {
      const global wt_exact_surface* mirror = sight->surfaces + chain[k - 1];
      const double above = wt_above(mirror, image), sign = above < 0.0 ? -1.0 : 1.0;
      const double above_0 = wt_above(mirror, l.b0), above_1 = wt_above(mirror, l.b1);
      if (sign * above_0 > margin_m && sign * above_1 > margin_m) return 0;
      // Lines that hardly cross the mirror's plane decide nothing.
      if (!(sign * above > margin_m && sign * above_0 < -margin_m && sign * above_1 < -margin_m)) return 1;
      l.a0 = image + (l.b0 - image) * (above / (above - above_0));
      l.a1 = image + (l.b1 - image) * (above / (above - above_1));
      if (misses(sight, chain[k - 1], &l)) return 0;
    }
    if (wt_hidden(sight, &l, hiders)) return 0;
    if (k == 0) return 1;
    image = wt_reflected(sight->surfaces + chain[k - 1], image);
    l.b0 = l.a0;
    l.b1 = l.a1;
    l.a0 = l.a1 = image;
  }
}

// One prefix per work-item, if it is of one of the first args.ends ends. Each bit of its pieces then stands for one of
// args.pieces pieces of its edge. A prefix that sees nothing of its edge gets the last key.
kernel void wedge_sight(const global WT_NODE* nodes, const global WT_LEAF* triangles,
                        const global wt_exact_surface* surfaces, const global uint* first_sides,
                        const global double* sides, const global wt_surface* boxes, const global wt_wedge* wedges,
                        const global ulong* table, global uint* keys, global wt_wedge_prefix* prefixes,
                        wt_sight_arguments args) {
  const uint i = get_global_id(0);
  if (i >= args.count || prefixes[i].end >= args.ends) return;
  const wt_sight sight = {nodes,       triangles, args.triangle_slots,  args.extent_m,   surfaces,
                          first_sides, sides,     args.static_surfaces, args.only_opaque};
  const global wt_wedge* w = wedges + wt_wedge_of(keys[i]);
  const double3 image = wt_image_of(prefixes + i);
  const double3 start = wt_on_edge(w, 0.0), end = wt_on_edge(w, w->length);
  uint chain[WT_MAX_DEPTH], root;
  const uint depth = wt_chain(table, prefixes[i].node, chain, &root);
  wt_part part = wt_shown_part(&sight, boxes, chain, depth, image, start, end, margin_of(image));
  wt_hiders hiders = {{WT_NONE, WT_NONE, WT_NONE, WT_NONE}};
  uint seen = 0, lowest = args.pieces, highest = 0;
  for (uint k = 0; k < args.pieces; ++k) {
    const double low = (double)k / args.pieces, high = (k + 1.0) / args.pieces;
    if (low > part.last || high < part.first ||
        !may_see(&sight, chain, depth, image, wt_on_edge(w, low * w->length), wt_on_edge(w, high * w->length), &hiders))
      continue;
    seen |= 1u << k;
    lowest = min(lowest, k);
    highest = k + 1;
  }
  prefixes[i].pieces = seen;
  if (seen == 0) keys[i] = WT_NONE;
  const double margin = 1e-3 + 1e-6 * w->length;
  prefixes[i].first = (float)(w->length * fmax(part.first, (double)lowest / args.pieces) - margin);
  prefixes[i].final = (float)(w->length * fmin(part.last, (double)highest / args.pieces) + margin);
  wt_weigh_prefix(w, prefixes + i);
}

// One sorted key per work-item: *seen becomes the number of prefixes that see something, whose keys come first.
kernel void count_in_sight(const global uint* keys, global uint* seen, uint count) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  if (i == 0 && keys[0] == WT_NONE) *seen = 0;
  if (keys[i] != WT_NONE && (i + 1 == count || keys[i + 1] == WT_NONE)) *seen = i + 1;
}
