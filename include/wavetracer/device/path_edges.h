// SPDX-License-Identifier: Apache-2.0
// The effect of each edge of a diffracted path on the wave. edges_of_path.h finds the edges.
#ifndef WAVETRACER_DEVICE_PATH_EDGES_H
#define WAVETRACER_DEVICE_PATH_EDGES_H
#include "wavetracer/device/edge_pair.h"
#include "wavetracer/device/edges_of_path.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Rays this close to the edge may be on either side of it, see wt_waves_at.
#define WT_UNDECIDED_M 2e-4

// A leg along a face counts as this far inside of free space: both faces of a half plane lie in one direction.
#define WT_INSIDE_RAD 1e-12

inline int wt_is_half_plane(const wt_edge* edge) { return edge->frame.exterior > 2.0 * WT_PI - 1e-9; }

// The normal of face 0 or 1, which points into free space.
inline wt_double3 wt_face_normal(const wt_wedge_frame* frame, int face) {
  if (face == 0) return frame->normal;
  const wt_double2 turn = wt_cos_sin(frame->exterior);
  return frame->face * turn.y - frame->normal * turn.x;
}

// A vector that points from the edge into face 0 or 1.
inline wt_double3 wt_into_face(const wt_wedge_frame* frame, int face) {
  if (face == 0) return frame->face;
  const wt_double2 turn = wt_cos_sin(frame->exterior);
  return frame->face * turn.x + frame->normal * turn.y;
}

// The surface of a face of the edge's wedge, as waves meet it from the free space around the edge.
inline wt_wedge_face wt_face_of(const wt_field_world* world, const wt_edge* edge, int face) {
  const wt_uint surface = world->wedges[edge->number].surfaces[face];
  const WT_GLOBAL wt_material* material = world->materials + world->materials_of[surface];
  wt_wedge_face out;
  out.permittivity = WT_DOUBLE2(material->permittivity[0], material->permittivity[1]);
  out.thickness_m = material->thickness_m;
  out.zone = wt_zone_cosine(edge->path_m, world->wavelength_m);
#if WT_LAYERS
  const wt_double3 normal = wt_face_normal(&edge->frame, face);
  out.layers = wt_layers_of(world->materials, material->layers,
                            wt_dot3(normal, wt_vector(world->surfaces[surface].normal)) < 0.0);
  out.permittivity = wt_met_permittivity(out.layers, out.permittivity);
#endif
  return out;
}

// If two edges bound one plane, the leg between them runs along it, even if rounding says otherwise. Along a sheet with
// two free edges one wave runs on each side; their signs differ at either end, so both arrive as the same. A leg runs
// in the open if it leaves one of the edges, or comes to it, on the side without the plane, as across a courtyard.
inline wt_shared_plane wt_snap_to_shared_plane(const wt_field_world* world, wt_edge* edges) {
  const wt_double3 away = edges[0].k_out, come = edges[1].k_in;
  wt_shared_plane plane;
  plane.sides = 0;
  for (int i = 0; i < 4; ++i) {
    const int v = i / 2, w = i % 2;
    if (world->wedges[edges[0].number].planes[v] != world->wedges[edges[1].number].planes[w]) continue;
    if (wt_dot3(wt_into_face(&edges[0].frame, v), away) <= 0.0) continue;
    if (wt_dot3(wt_into_face(&edges[1].frame, w), come) >= 0.0) continue;
    const wt_double3 n = wt_face_normal(&edges[0].frame, v), m = wt_face_normal(&edges[1].frame, w);
    const double rise_m = fmax(fabs(wt_dot3(n, away)), fabs(wt_dot3(m, come))) * edges[0].after_m;
    if (wt_dot3(n, m) < 0.0 || rise_m > WT_ALONG_PLANE_M || ++plane.sides > 1) continue;
    edges[0].k_out = wt_normalized(away - n * (wt_dot3(away, n) - WT_INSIDE_RAD));
    edges[1].k_in = wt_normalized(come - m * (wt_dot3(come, m) + WT_INSIDE_RAD));
    plane.normal = n;
    plane.faces[0] = wt_face_of(world, edges, v);
    plane.faces[1] = wt_face_of(world, edges + 1, w);
  }
  if (!wt_is_half_plane(edges) || !wt_is_half_plane(edges + 1)) plane.sides = plane.sides > 0;
  return plane;
}

// A wave that passes the edge of a corner as a ray: reflected `count` times at the wedge's surfaces, in turn, from
// surfaces[first] on. With 0 it goes straight past it.
typedef struct {
  wt_uint surfaces[2];
  wt_uint count;
  int first;
} wt_image_steps;

// Do these steps reflect in one plane?
inline int wt_same_mirror(const wt_field_world* world, wt_uint step, wt_uint surface) {
  if ((step & WT_STEP_KIND) != WT_STEP_REFLECTION) return 0;
  if (step == (WT_STEP_REFLECTION | surface)) return 1;
  const WT_GLOBAL wt_exact_surface *a = world->surfaces + (step & ~WT_STEP_KIND), *b = world->surfaces + surface;
  const wt_double3 n = wt_vector(a->normal), m = wt_vector(b->normal);
  const double cosine = wt_dot3(n, m);
  return wt_length3(wt_cross3(n, m)) <= 1e-9 && fabs(a->offset - (cosine < 0.0 ? -b->offset : b->offset)) <= 1e-4;
}

// Has the sibling the steps of the path, except that it is reflected as `image` says in place of step `at`?
inline int wt_differs_at(const wt_field_world* world, const wt_path* path, const wt_path* sibling, wt_uint at,
                         const wt_image_steps* image) {
  if (sibling->depth + 1u != path->depth + image->count) return 0;
  for (wt_uint k = 0; k < sibling->depth; ++k) {
    if (k >= at && k < at + image->count) {
      const wt_uint face = (wt_uint)image->first != ((k - at) % 2u == 1u);
      if (!wt_same_mirror(world, wt_step(sibling, k), image->surfaces[face])) return 0;
    } else if (wt_step(sibling, k) != wt_step(path, k < at ? k : k + 1u - image->count)) {
      return 0;
    }
  }
  return 1;
}

// Is there such a path of the same link whose delay is that of this row to a picosecond?
inline int wt_has_sibling(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row, const wt_path* path,
                          wt_uint at, const wt_image_steps* image) {
  for (int way = -1; way <= 1; way += 2)
    for (wt_uint i = row + (wt_uint)way; i < ordered->count; i += (wt_uint)way) {  // before 0 is beyond count
      if (!(fabs(ordered->delays[i] - ordered->delays[row]) < 1e-12)) break;
      if (ordered->rows[i] == WT_NO_ROW) continue;
      const wt_path sibling = wt_path_of(ordered->list, ordered->rows[i]);
      if (sibling.transmitter != path->transmitter || sibling.receiver != path->receiver) break;
      if (wt_differs_at(world, path, &sibling, at, image)) return 1;
    }
  return 0;
}

// Near a boundary of the edge the rows tell on which side the receiver is: lines of legs begin and end 0.1 mm beside
// what they leave, vehicles are met in float32, and reflections so close to each other are one path.
inline wt_known_waves wt_waves_at(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                                  const wt_path* path, const wt_edge* edge, const wt_turn* turn) {
  wt_known_waves known = wt_nothing_known();
  const double angle = WT_UNDECIDED_M * (1.0 / edge->before_m + 1.0 / edge->after_m);
  known.undecided = fmin(WT_UNDECIDED_RAD + angle, 1e-3);
  for (int i = 0; i < WT_BOUNDARIES; ++i) {
    const wt_boundary boundary = turn->boundaries[i];
    if (fabs(boundary.epsilon) > known.undecided || !wt_has_wave(&edge->frame, boundary)) continue;
    wt_image_steps image;
    image.surfaces[0] = world->wedges[edge->number].surfaces[0];
    image.surfaces[1] = world->wedges[edge->number].surfaces[1];
    image.count = (wt_uint)(boundary.image < 0 ? -boundary.image : boundary.image);
    image.first = boundary.image > 0;
    known.lit[i] = wt_has_sibling(world, ordered, row, path, edge->at, &image);
  }
  return known;
}

// The turn of the path at an edge, with what is known of the waves there.
inline wt_known_waves wt_known_at(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                                  const wt_path* path, const wt_edge* edge, wt_turn* turn) {
  *turn = wt_turn_at(&edge->frame, edge->k_in, edge->k_out);
  wt_known_waves known = wt_waves_at(world, ordered, row, path, edge, turn);
  known.most_images = (int)(world->reflections + 1u) - (int)path->depth;
  return known;
}

inline int wt_edge_transmits(const wt_field_world* world, const wt_edge* edge) {
  return world->transmissions >= (wt_is_half_plane(edge) ? 1u : 2u);
}

// Applies the diffraction at one edge of the path.
inline void wt_diffract_at(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                           const wt_path* path, const wt_edge* edge, const wt_edge_ends* ends, wt_transfer* transfer) {
  wt_turn turn;
  const wt_known_waves known = wt_known_at(world, ordered, row, path, edge, &turn);
  const wt_wedge_face faces[2] = {wt_face_of(world, edge, 0), wt_face_of(world, edge, 1)};
  const double legs_m[2] = {edge->before_m, edge->after_m};
  const double distance_m = edge->before_m * edge->after_m / (edge->before_m + edge->after_m) * wt_sine2(edge);
  const wt_wave_map wave = wt_diffract(edge->frame, faces, edge->k_in, edge->k_out, &turn, legs_m, distance_m,
                                       world->wavelength_m, wt_edge_transmits(world, edge), &known, ends);
  wt_map(transfer, wave.from, wave.to, wave.matrix);
}

// The bend of the path at an edge of several, with what is known of the waves there.
inline wt_bend wt_bend_on_path(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                               const wt_path* path, const wt_edge* edge, wt_known_waves* known) {
  wt_turn turn;
  *known = wt_known_at(world, ordered, row, path, edge, &turn);
  const wt_wedge_face faces[2] = {wt_face_of(world, edge, 0), wt_face_of(world, edge, 1)};
  const double legs_m[2] = {edge->before_m, edge->after_m};
  return wt_bend_at(&edge->frame, faces, edge->k_in, edge->k_out, legs_m, &turn, world->wavelength_m,
                    wt_edge_transmits(world, edge));
}

// The form of the leg between edges[0] and edges[1].
inline wt_pair_form wt_form_between(const wt_edge* edges) {
  const wt_edge *a = edges, *b = edges + 1;
  const wt_double3 along[2] = {a->frame.along, b->frame.along};
  const double sine2[2] = {wt_sine2(a), wt_sine2(b)};
  return wt_pair_form_of(along, a->k_out, a->before_m, a->after_m, b->after_m, sine2);
}

// Applies two diffractions that follow each other. between: what the leg between the edges does to a wave.
inline void wt_diffract_at_two(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                               const wt_path* path, const wt_edge* edges, const wt_shared_plane* plane,
                               const wt_transfer* between, wt_transfer* transfer) {
  wt_bend bends[2];
  wt_known_waves known[2];
  for (int i = 0; i < 2; ++i) bends[i] = wt_bend_on_path(world, ordered, row, path, edges + i, known + i);
  const wt_pair_form form = wt_form_between(edges);
  const wt_wave_map wave = wt_diffract_at_pair(bends, known, &form, between, plane);
  wt_map(transfer, wave.from, wave.to, wave.matrix);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
