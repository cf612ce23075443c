// SPDX-License-Identifier: Apache-2.0
// Records of discovery by beams (docs/design/beams.md): what an image sees through the part of a mirror that it lights.
#ifndef WAVETRACER_DEVICE_BEAMS_H
#define WAVETRACER_DEVICE_BEAMS_H
#include "wavetracer/device/records.h"

// The most corners of a facet, and of a convex polygon that cuts make of it. A cut that would need more is left out, so
// the polygon is larger.
#define WT_FACET_CORNERS 8u
#define WT_CORNERS 12u
// The most pieces of a facet that wait in a group to be cut by the next candidates.
#define WT_PIECES 24u
// The most walls that a piece knows to be between it and the image. Where more would be, they hide nothing.
#define WT_WALLS 8u
// Candidates of an aperture are stored in chunks of this many.
#define WT_CHUNK 32u
// Pieces that fill less of the source's sphere are not followed, but counted, steradians.
#define WT_LEAST_SR 1e-13
// Solid angles are added up as integers of this unit (2^-60 sr), so that their sum does not depend on any order.
#define WT_SR_UNIT 8.673617379884035e-19
// The unit of sums that may be the whole sphere of many ends (2^-40 sr).
#define WT_WEAK_SR_UNIT 9.094947017729282e-13
// A material's bounds of its power reflectance, one for each of this many equal ranges of the cosine of incidence.
#define WT_COSINES 64u

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
  wt_uint passed;   // walls that waves have passed on their way to the mirror
  float kept;       // a bound of the share of the power that is left after all mirrors, this one too; 1 at a root
  // Not 0: only surfaces of instances are looked for, all of which lie in a box of the view (lib/view.clh) and no
  // deeper than this, m.
  wt_uint only_moving;
  float low_u, high_u, low_v, high_v, deepest;
} wt_aperture;

// The most planes of a lit space: sides, the mirror, the sides of a box, and one that ends it.
#define WT_LIT_PLANES (WT_CORNERS + 6u)

// The space that an image lights through an aperture. Coordinates are relative to the image.
typedef struct {
  double n[3], u[3], v[3];  // the view: a point p is at (u . p, v . p) / (n . p), and n . p > 0 for all that is lit
  double height;            // n . p >= height beyond the mirror; 0 at a root
  double planes[4 * WT_LIT_PLANES];    // inside: n . p >= c, as n[3], c
  float low_u, high_u, low_v, high_v;  // the box of the aperture in the view
  wt_uint count;                       // planes
  wt_uint padding;
} wt_lit_space;

// Uses of a facet that an image may see: it may be the next mirror; or the image lies in its plane, so that only its
// edges may be seen.
#define WT_MIRROR 1u
#define WT_EDGE_ON 2u

// A facet that an image may see through an aperture, and the part of its view that the facet lies in: a point p from
// the image on is at (u . p, v . p) / (n . p), and 1 / (n . p) falls with its depth (lib/view.clh).
typedef struct {
  float low_u, high_u, low_v, high_v;
  float nearest, farthest;  // largest and smallest 1 / (n . p)
  wt_uint facet;
  wt_uint use;  // 0: it only hides others; WT_MIRROR, WT_EDGE_ON
} wt_beam_candidate;

typedef struct {
  wt_uint aperture;
  wt_uint first;  // the first chunk of the aperture
  wt_uint next;   // the next one, WT_NONE after the last
  wt_uint count;  // candidates
} wt_chunk;

// The planes of an aperture's lit space, n . p >= c, and those of the largest facets that hide others there
// (lib/outlook.clh): plane k of facet s is at 16 k + s, and all of its planes hold for what it hides.
#define WT_OUTLOOK_SCREENS 16u
#define WT_SCREEN_PLANES 6u
typedef struct {
  float nx[16], ny[16], nz[16], c[16];
  float screen_nx[WT_SCREEN_PLANES * WT_OUTLOOK_SCREENS], screen_ny[WT_SCREEN_PLANES * WT_OUTLOOK_SCREENS],
      screen_nz[WT_SCREEN_PLANES * WT_OUTLOOK_SCREENS], screen_c[WT_SCREEN_PLANES * WT_OUTLOOK_SCREENS];
  float reach;  // screens surely hide only what is not farther from the image than this, m
  wt_uint padding[3];
} wt_outlook;

// The box of an instance that is present, recentred coordinates, m.
typedef struct {
  double low[3], high[3];
} wt_instance_box;

// Surfaces that waves pass between an image and a piece, each once where several are one wall.
typedef struct {
  wt_uint surface[WT_WALLS];
  wt_uint count;
} wt_walls;

// A piece of a facet that is not cut to the end yet: corners in the plane of the facet's surface, m.
typedef struct {
  double u[WT_CORNERS], v[WT_CORNERS];
  wt_uint count;      // corners
  wt_uint candidate;  // the facet
  wt_uint next;       // the next candidate that may hide some of it, WT_NONE: there is none
  wt_walls walls;
} wt_waiting_piece;

// Counters of the kernels. A sum of solid angles has two words, low and high.
typedef struct {
  wt_uint left_out[2];    // pieces that are not followed because they are thin, in WT_SR_UNIT
  wt_uint thin[2];        // the same, each times the share of the power that is left there
  wt_uint weak[2];        // pieces whose paths are too weak to follow, times that share, in WT_WEAK_SR_UNIT
  wt_uint chunks;         // may exceed the capacity: grow and run again
  wt_uint apertures;      // as chunks
  wt_uint trie_overflow;  // not 0: no slot was found
  wt_uint waiting[2];     // as chunks: pieces that are not cut to the end, of an even and of an odd round
  wt_uint most_waiting;   // set where these exceed the capacity
} wt_beam_counters;

typedef struct {
  wt_uint first;     // the first aperture
  wt_uint count;     // apertures (beam_gather) or chunks (beam_visible)
  wt_uint capacity;  // the length of the list of chunks (beam_gather) or apertures (beam_visible) that is written
  wt_uint waiting_capacity;
  wt_uint trie_mask;
  wt_uint round;     // the number of the launch of beam_waiting: 1, 2, ...; 0: beam_visible
  wt_uint last;      // not 0: nodes are entered, and no apertures are made
  wt_uint walls;     // surfaces that are not opaque that a wave may have passed before it is reflected at this depth
  wt_uint edges;     // not 0: edges diffract, so surfaces are also entered where only their edges may be seen
  wt_uint root;      // the node of the tree that beam_gather begins at
  wt_uint outlooks;  // not 0: beam_gather writes what apertures keep
} wt_beam_arguments;

// The power below which paths are not followed (lib/floor.clh). All receivers are in the box, recentred coordinates, m.
typedef struct {
  double low[3], high[3];
  double reach_m;  // the length of a path that loses nothing at mirrors and has this power; infinity: all are followed
} wt_floor;

#endif
