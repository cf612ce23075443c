// SPDX-License-Identifier: Apache-2.0
// grazed_faces: enters the faces that an end sees at grazing, beside faces that its rays have met. Such a face is a
// thin strip for rays, so they may miss it; but the prefix that sees one face of an edge also sees the other one, if
// that does not face away. A node of the trie is a prefix and the surface that its rays met next. Images are exact; an
// edge that the last mirror surely does not show (float32, conservative) is passed over. Later passes decide if
// something hides the face, as for all sequences. Only sequences that rays have met are looked at, in this frame or
// before: if the pass runs again, those that it has entered lead to no others.
#include "lib/enter.clh"
#include "lib/join.clh"
#include "lib/wedge.clh"
#pragma OPENCL FP_CONTRACT OFF

// A face is grazed below this sine of the elevation, in the plane that is perpendicular to the edge.
#define WT_GRAZED 0.1

// The height of a point in wt_in_wedge's coordinates above the plane of face 0 or 1.
inline double above_face(const global wt_wedge* w, double3 at, int face) {
  return face == 0 ? at.z : w->sine * at.y - w->cosine * at.z;
}

// The other face of a wedge that has the face `seen`, if the image sees it at grazing, or WT_NONE. last: the last of
// `mirrors` mirrors.
inline uint grazed_face(const global wt_wedge* w, const global wt_surface* boxes, uint seen, uint mirrors, uint last,
                        double3 image) {
  const int face = w->surfaces[0] == seen;
  const uint other = w->surfaces[face];
  if (other == seen || (mirrors > 0 && other == last)) return WT_NONE;  // a surface never follows itself
  const double3 at = wt_in_wedge(w, image);
  const double above = above_face(w, at, face);
  const int grazed = above > 0.0 && above < WT_GRAZED * wt_from_edge(at);
  return grazed && wt_shows_wedge(w, boxes, mirrors, last, image, at) ? other : WT_NONE;
}

// lanes work-items per node, which share the ends of its root (first_ends). surface_wedges: see wedge_prefixes.
// The first counters->nodes nodes are looked at, at most node_count; new ones are listed after all others, as far
// as there is room.
kernel void grazed_faces(global ulong* table, global uint* nodes, const global double4* ends,
                         const global uint* first_ends, const global wt_exact_surface* surfaces,
                         const global wt_surface* boxes, const global uint* first_wedges, const global uint* sides,
                         const global uint* surface_wedges, const global wt_wedge* wedges, global uint* quarters,
                         global wt_counters* counters, global uint* ages, uint mask, uint node_count, uint capacity,
                         uint now, uint lanes) {
  const uint i = get_global_id(0) / lanes, lane = get_global_id(0) % lanes;
  if (i >= min(node_count, counters->nodes) || (nodes[i] & WT_ROOT)) return;
  const uint found = wt_load_relaxed_u32(quarters + nodes[i]) & WT_ALL_QUARTERS;
  if (found == 0) return;
  uint back[WT_MAX_DEPTH], depth = 0, n = nodes[i];  // the surfaces from the last one back
  for (; !(n & WT_ROOT) && depth < WT_MAX_DEPTH; ++depth) {
    const ulong key = wt_load_relaxed_u64(table + n);  // others are inserting
    back[depth] = wt_trie_surface(key);
    n = wt_trie_parent(key);
  }
  const uint root = n & ~WT_ROOT, parent = wt_trie_parent(wt_load_relaxed_u64(table + nodes[i]));
  const uint mirrors = depth - 1, seen = back[0], last = mirrors > 0 ? back[1] : WT_NONE;
  for (uint end = first_ends[root] + lane; end < first_ends[root + 1]; end += lanes) {
    double3 image = ends[end].xyz;
    for (uint k = mirrors; k > 0; --k) image = wt_reflected(surfaces + back[k], image);
    const uint own = mirrors == 0 ? wt_end_instance(ends[end]) : WT_NONE;  // it neither hides nor diffracts
    const uint2 range = wt_wedges_seen(surfaces, first_wedges, sides, seen, image);
    for (uint k = range.x; k < range.y; ++k) {
      const global wt_wedge* w = wedges + surface_wedges[k];
      if (own != WT_NONE && w->instance == own) continue;
      const uint face = grazed_face(w, boxes, seen, mirrors, last, image);
      if (face == WT_NONE) continue;
      const uint node = wt_enter(table, mask, parent, face, nodes, capacity, counters, quarters, found, ages, now);
      if (node == WT_NONE) atomic_or(&counters->trie_overflow, 1u);
    }
  }
}
