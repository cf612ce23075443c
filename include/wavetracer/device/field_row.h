// SPDX-License-Identifier: Apache-2.0
// The row of a path in the results: its field (path_field.h) and its vertices.
#ifndef WAVETRACER_DEVICE_FIELD_ROW_H
#define WAVETRACER_DEVICE_FIELD_ROW_H
#include "wavetracer/device/path_field.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The vertices of a path, from first_vertex on. origin: of recentred coordinates in those of the file.
inline void wt_write_vertices(const wt_field_world* world, const wt_path* path, wt_double3 origin, wt_uint first_vertex,
                              WT_GLOBAL wt_vertex_row* vertices) {
  for (wt_uint k = 0; k < path->depth; ++k) {
    const wt_uint step = wt_step(path, k);
    const wt_double3 p = wt_vertex(path, k) + origin;
    WT_GLOBAL wt_vertex_row* vertex = vertices + first_vertex + k;
    vertex->position[0] = p.x;
    vertex->position[1] = p.y;
    vertex->position[2] = p.z;
    vertex->surface = wt_local_number(world, step);
    vertex->instance = wt_step_instance(world, step);
    vertex->interaction = wt_interaction(step);
    vertex->padding = 0;
  }
}

// The codes of all interactions of a path together, in the bits of wt_path_row.quarters.
inline wt_uint wt_met_kinds(const wt_path* path) {
  wt_uint met = 0;
  for (wt_uint k = 0; k < path->depth; ++k) met |= wt_interaction(wt_step(path, k));
  return met << WT_ROW_MET_SHIFT;
}

// The row at `place`, and its vertices, unless `vertices` is null.
inline void wt_write_row(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint place, wt_uint quarters,
                         wt_double3 origin, wt_uint first_vertex, WT_GLOBAL wt_path_row* row,
                         WT_GLOBAL wt_vertex_row* vertices) {
  const wt_path path = wt_path_of(ordered->list, ordered->rows[place]);
  const wt_path_field field = wt_field_of(world, ordered, place);
  row->tx = path.transmitter;
  row->rx = path.receiver;
  row->first_vertex = first_vertex;
  row->quarters = quarters | (field.near_edge ? WT_ROW_NEAR_EDGE : 0u) | wt_met_kinds(&path);
  row->delay_s = field.delay_s;
  row->gain_db = field.gain_db;
  row->doppler_hz = field.doppler_hz;
  row->aod_theta = field.departure.theta;
  row->aod_phi = field.departure.phi;
  row->aoa_theta = field.arrival.theta;
  row->aoa_phi = field.arrival.phi;
  for (int i = 0; i < 4; ++i) {
    row->a[2 * i] = field.a[i].x;
    row->a[2 * i + 1] = field.a[i].y;
  }
  if (vertices) wt_write_vertices(world, &path, origin, first_vertex, vertices);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
