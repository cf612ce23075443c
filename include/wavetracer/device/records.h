// SPDX-License-Identifier: Apache-2.0
// Records and constants that both C++ (host/passes) and OpenCL C (kernels) compile: nothing else is shared. There is no
// float3, bool, size_t or pointer; padding is explicit; tests/gpu compares sizes and offsets on the device.
#ifndef WAVETRACER_DEVICE_RECORDS_H
#define WAVETRACER_DEVICE_RECORDS_H

#include "wavetracer/device/types.h"

// The longest chain of interactions; private arrays of the exact solve have this size.
#define WT_MAX_DEPTH 64u

// A point closer than this to a surface's plane is on that surface: the surface does not hide an antenna there, and
// does not reflect or scatter to it. This is ten times the float32 rounding of coordinates of a kilometre, and less
// than the thickness of any wall.
#define WT_ON_SURFACE_M 1e-4

// A leg from one edge to another runs along a plane that bounds both if it rises above it or sinks below it by no more
// than this: each edge, and the surfaces between them, may be off the plane by WT_ON_SURFACE_M.
#define WT_ALONG_PLANE_M (3.0 * WT_ON_SURFACE_M)

// The most diffractions of one path; private arrays of its solve and of its field have this size.
#define WT_MOST_EDGES 8u

// Structure of arrays: a ray queue of capacity n is WT_RAY_PLANES * n words; plane p of ray i is word p * n + i.
#define WT_RAY_ORIGIN 0     // three planes, float
#define WT_RAY_DIRECTION 3  // three planes, float, unit length
#define WT_RAY_NODE 6       // trie node of the prefix that the ray has passed so far, or a root; and its quarter
#define WT_RAY_SURFACE 7    // surface that the ray left, WT_NONE at a transmitter
#define WT_RAY_PLANES 8
// This plane is added where samples are followed (WT_SAMPLES, WT_LABELS): the number of the sample, counted in its
// launch.
#define WT_RAY_SAMPLE 8
// These are added with a ray cache or waypoints (WT_LABELS, written by label_rays and interact):
#define WT_RAY_LEFT 9     // primitive that the ray left, WT_NONE at a transmitter
#define WT_RAY_REGION 10  // transmitter that launched it
#define WT_RAY_ENTRY 11   // cache entry of the segment before, or WT_NONE
#define WT_RAY_LABELLED_PLANES 12

// A hit list of capacity n is WT_HIT_PLANES * n words.
#define WT_HIT_T 0          // float, distance; undefined on a miss
#define WT_HIT_PRIMITIVE 1  // WT_NONE on a miss
#define WT_HIT_SURFACE 2    // WT_NONE on a miss
#define WT_HIT_PLANES 3

#define WT_NONE 0xFFFFFFFFu
#define WT_EMPTY 0xFFFFFFFFFFFFFFFFul

// A trie node is its slot; its key is (parent << 32) | surface. The parent of a first surface is the root of a
// transmitter.
#define WT_ROOT 0x80000000u
// The rays of a launch are numbered, and the number modulo 4 is the ray's quarter. It is held in two bits of
// WT_RAY_NODE that no slot and no transmitter needs. A ray whose prefix found no slot has WT_NONE there.
#define WT_QUARTER_SHIFT 29u
#define WT_QUARTER_BITS 0x60000000u
inline wt_uint wt_with_quarter(wt_uint node, wt_uint number) { return node | (number & 3u) << WT_QUARTER_SHIFT; }
inline wt_uint wt_quarter_bit(wt_uint word) { return 1u << (word >> WT_QUARTER_SHIFT & 3u); }
// A sequence or path has a bit for each quarter that found it.
#define WT_ALL_QUARTERS 15u

// A surface as discovery needs it (float32, recentred).
typedef struct {
  float normal[3];
  float offset;
  float lower[4];  // bounding box; [3] is padding
  float upper[4];
} wt_surface;

// A surface as the exact solve needs it (double, recentred).
typedef struct {
  double normal[3];
  double offset;
  wt_uint first_triangle;  // place in the list of surface triangles (nine doubles each)
  wt_uint triangle_count;
  wt_uint instance;  // instance in whose model coordinates the triangles are; WT_NONE: in those of the scene
  wt_uint opaque;    // not 0: no wave passes it
} wt_exact_surface;

// A surface of a model, in model coordinates.
typedef struct {
  double normal[3];
  double offset;
  double lower[3];
  double upper[3];
  wt_uint first_triangle;
  wt_uint triangle_count;
} wt_model_surface;

// An instance in a frame: p in model coordinates is at position + rotation p, and moves with velocity +
// angular_velocity x (rotation p), m/s and rad/s. Its surfaces are first_surface + k, those of its model
// first_model_surface + k, its wedges first_wedge + k.
typedef struct {
  double rotation[9];  // row by row
  double position[3];
  double velocity[3];
  double angular_velocity[3];
  wt_uint first_surface;
  wt_uint first_model_surface;
  wt_uint first_wedge;
  wt_uint present;
} wt_exact_instance;

// Bits of wt_target_point::present. A point that is a piece of a surface is lit where it is seen from above its
// surface, from below it, or from both.
#define WT_POINT_PRESENT 1u
#define WT_POINT_LIT_ABOVE 2u
#define WT_POINT_LIT_BELOW 4u

// A point of a target in a frame (host/simulation/world_targets.hpp), recentred.
typedef struct {
  double rotation[9];  // from the axes of the target to those of the scene, row by row
  double position[3];
  double velocity[3];
  wt_uint instance;  // the vehicle that carries it, which hides nothing from it; WT_NONE without a body
  wt_uint law;       // its law, see wt_target_law
  wt_uint present;   // bits of WT_POINT_PRESENT; 0: absent
  wt_uint surface;   // the surface that it is a piece of, all others of which may hide it; else WT_NONE
} wt_target_point;

// The step of a vertex of a solved path: one of up to eight kinds (wavetracer/interaction_kinds.hpp), and the number of
// a surface (reflection, transmission), wedge, tile or point of a target.
#define WT_STEP_SHIFT 29u
#define WT_STEP_KIND (7u << WT_STEP_SHIFT)
#define WT_STEP_REFLECTION (0u << WT_STEP_SHIFT)
#define WT_STEP_TRANSMISSION (1u << WT_STEP_SHIFT)
#define WT_STEP_DIFFRACTION (2u << WT_STEP_SHIFT)
#define WT_STEP_SCATTERING (3u << WT_STEP_SHIFT)
#define WT_STEP_TARGET (4u << WT_STEP_SHIFT)
// The codes of these kinds in files (Interaction in wavetracer/paths.hpp), a byte each, the first kind's the lowest.
#define WT_STEP_CODES (1ul | 4ul << 8 | 8ul << 16 | 2ul << 24 | 16ul << 32)

// Ends of an edge beyond which its line runs on in the open: there its wave ends with the wave of a corner.
#define WT_FREE_START 1u
#define WT_FREE_END 2u
// From this detour over an end on, in wavelengths, the edge is as one without an end (edge_ends.h). Paths over an end
// are put this far inside of it.
#define WT_END_DETOUR 2.0
#define WT_END_INSET_M 1e-3

// A wedge of the world (double, recentred), see Wedge in wavetracer/scene.hpp.
typedef struct {
  double start[3];
  double along[3];
  double face[3];
  double normal[3];
  double length;
  double exterior;      // radians
  double cosine, sine;  // those of exterior
  wt_uint surfaces[2];  // numbers in the world
  wt_uint planes[2];    // surfaces that stand for the planes of the faces
  wt_uint instance;     // WT_NONE: static
  wt_uint free_ends;    // WT_FREE_START, WT_FREE_END
} wt_wedge;

// A candidate: a sequence (trie node or root) with a receiver.
typedef struct {
  wt_uint node;
  wt_uint receiver;
} wt_candidate;

// In the place of a sequence's last surface: the wedge that rays came from, in sequences that listeners have heard.
#define WT_HEARD_WEDGE 0x80000000u

// An edge is cut into pieces of equal length; a mask of bits says which of them something may see. Pairs of edges have
// this many pieces each.
#define WT_WEDGE_PIECES 4u

// A prefix of an end that sees a wedge. Ends are transmitters, then the receivers that launch for themselves.
typedef struct {
  wt_uint node;      // trie node of the prefix, or a root
  wt_uint end;       // a place in the list of ends (radio_ends.hpp)
  wt_uint depth;     // number of reflections
  wt_uint last;      // surface of the last reflection
  float image[3];    // image of the end in all reflections
  float along;       // foot of the image on the edge's line, from the start of the edge
  float away;        // distance of the image from that line
  float length;      // length of the edge
  wt_uint quarters;  // quarters that found it
  wt_uint pieces;    // pieces of the edge that it may see
  float first;       // place on the edge before which it sees nothing
  float final;       // place on the edge behind which it sees nothing
  float azimuth;     // set by wedge_sight: the image's azimuth about the edge, from face 0
  float nearness;    // set by wedge_sight: the longest way to the edge over the square of away, 1/m
} wt_wedge_prefix;

// The key that sorts such prefixes: the wedge, then the depth, so that those that are short enough stand together.
#define WT_WEDGE_DEPTH_BITS 5u
inline wt_uint wt_wedge_key(wt_uint wedge, wt_uint depth) { return wedge << WT_WEDGE_DEPTH_BITS | depth; }
inline wt_uint wt_wedge_of(wt_uint key) { return key >> WT_WEDGE_DEPTH_BITS; }

// A candidate of a diffracted path: prefixes of a transmitter and of the receiver's end, and one wedge or two (else
// WT_NONE) between them, in the order from the transmitter.
typedef struct {
  wt_uint node;
  wt_uint back;
  wt_uint wedges[2];
  wt_uint receiver;
  wt_uint quarters;  // quarters that found both prefixes
} wt_wedge_candidate;

// A solved candidate. Its vertex j is the three doubles at (index * max_depth + j) * 3, and its surface, with
// WT_STEP_KIND, is at index * max_depth + j.
typedef struct {
  wt_uint transmitter;
  wt_uint receiver;
  wt_uint depth;
  wt_uint blocked;   // 0 until a leg is found obstructed
  wt_uint node;      // node of its sequence; WT_NONE if it is diffracted
  wt_uint quarters;  // quarters of the launch that found it
} wt_solved;

// Counters that the passes share: one small buffer, cleared in each frame. Each has a line of memory for itself.
// Otherwise a kernel that reads one counter for every element and adds to another would wait for the line, which each
// core takes from the others.
#define WT_REST_OF_LINE 15u
typedef struct {
  wt_uint nodes;                                                 // used slots of the trie, as they are listed
  wt_uint exchanged, exchanged_rest[WT_REST_OF_LINE - 1u];       // those that exchanges added, listed after them
  wt_uint trie_overflow, trie_overflow_rest[WT_REST_OF_LINE];    // no slot was found: grow, and trace the batch again
  wt_uint candidates, candidates_rest[WT_REST_OF_LINE];          // may exceed the capacity: grow and run again
  wt_uint solved, solved_rest[WT_REST_OF_LINE];                  // as candidates
  wt_uint hidden, hidden_rest[WT_REST_OF_LINE];                  // hidden by what hid the path before
  wt_uint visible, visible_rest[WT_REST_OF_LINE];                // may exceed the capacity, as candidates
  wt_uint wedge_prefixes, wedge_prefixes_rest[WT_REST_OF_LINE];  // as candidates
  wt_uint wedge_candidates, wedge_candidates_rest[WT_REST_OF_LINE];  // as candidates
  wt_uint wedge_solved, wedge_solved_rest[WT_REST_OF_LINE];          // as candidates
  wt_uint chains, chains_rest[WT_REST_OF_LINE];                      // as candidates
  wt_uint rows, rows_rest[WT_REST_OF_LINE];                          // rows of paths
  wt_uint row_vertices, row_vertices_rest[WT_REST_OF_LINE];          // their interactions
  wt_uint near_rows, near_rows_rest[WT_REST_OF_LINE];                // left out: an antenna touches what reflects
  wt_uint ended[WT_MAX_DEPTH + 1u];                                  // rays of bounces by their number of hits
  wt_uint ended_rest[WT_REST_OF_LINE];
} wt_counters;

#endif
