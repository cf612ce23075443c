// SPDX-License-Identifier: Apache-2.0
// Records of discovery by beams (docs/design/beams.md): what an image sees through the part of a mirror that it lights.
#ifndef WAVETRACER_DEVICE_BEAMS_H
#define WAVETRACER_DEVICE_BEAMS_H
#include "wavetracer/device/records.h"

// The most corners of a facet, and of a convex polygon that cuts make of it. A cut that would need more is left out, so
// the polygon is larger.
#define WT_FACET_CORNERS 8u
#define WT_CORNERS 12u
// The most pieces of a facet that wait to be cut by the next candidates. Where more would wait, a cut is left out.
#define WT_PIECES 24u
// Candidates of an aperture are stored in chunks of this many.
#define WT_CHUNK 32u
// Pieces that fill less of the source's sphere are not followed, but counted, steradians.
#define WT_LEAST_SR 1e-13
// Solid angles are added up as integers of this unit (2^-60 sr), so that their sum does not depend on any order.
#define WT_SR_UNIT 8.673617379884035e-19

// A convex part of a surface: triangles of one surface, put together. Its corners go around the normal.
typedef struct {
  double normal[3];
  double low, high;  // all corners have low <= normal . p <= high, recentred coordinates, m
  wt_uint first_corner;
  wt_uint count;
  wt_uint surface;
  wt_uint padding;
} wt_facet;

// A convex part of a mirror that its image lights, recentred coordinates. A root is a face of a cube around an end; it
// has no mirror, and the image is the end itself.
typedef struct {
  double image[3];
  double corners[3 * WT_CORNERS];
  wt_uint count;    // corners
  wt_uint node;     // the trie's node of the sequence that ends at the mirror, or a root
  wt_uint surface;  // the mirror; WT_NONE at a root
  wt_uint own;      // the instance that carries the end; it neither reflects nor hides at a root. WT_NONE: no instance
} wt_aperture;

// A facet that an image may see through an aperture, and the part of its view that the facet lies in: a point p from
// the image on is at (u . p, v . p) / (n . p), and 1 / (n . p) falls with its depth (lib/view.clh).
typedef struct {
  float low_u, high_u, low_v, high_v;
  float nearest, farthest;  // largest and smallest 1 / (n . p)
  wt_uint facet;
  wt_uint may_reflect;  // 0: it only hides others
} wt_beam_candidate;

typedef struct {
  wt_uint aperture;
  wt_uint first;  // the first chunk of the aperture
  wt_uint next;   // the next one, WT_NONE after the last
  wt_uint count;  // candidates
} wt_chunk;

// Counters of both kernels.
typedef struct {
  wt_uint left_out[2];    // solid angle of pieces that are not followed, in WT_SR_UNIT: low word, high word
  wt_uint chunks;         // may exceed the capacity: grow and run again
  wt_uint apertures;      // as chunks
  wt_uint trie_overflow;  // not 0: no slot was found
  wt_uint kept_whole;     // pieces that were not cut, since there was no room for more of them
} wt_beam_counters;

typedef struct {
  wt_uint first;     // apertures from this one on (beam_gather)
  wt_uint count;     // apertures (beam_gather) or chunks (beam_visible)
  wt_uint capacity;  // the length of the list that is written
  wt_uint trie_mask;
  wt_uint last;         // not 0: nodes are entered, and no apertures are made
  wt_uint only_opaque;  // not 0: waves pass surfaces that are not opaque, so only opaque ones hide
} wt_beam_arguments;

#endif
