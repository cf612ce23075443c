// SPDX-License-Identifier: Apache-2.0
// The wave of one path, interaction by interaction: delay, angles, coefficients and Doppler shift of a row.
// Spreading is 1 / L for a path of length L without edges, else that of path_edges.h. The geometry is that of the exact
// solve: specular reflections, straight transmissions, one diffuse scattering or one point of a target with up to one
// diffraction on either side of it, or up to WT_MOST_EDGES diffractions. A tile or a point ends one wave and begins
// another, so mirrors and edges on either side of it see the length on their side.
#ifndef WAVETRACER_DEVICE_PATH_FIELD_H
#define WAVETRACER_DEVICE_PATH_FIELD_H
#include "wavetracer/device/antenna.h"
#include "wavetracer/device/losses.h"
#include "wavetracer/device/path_ends.h"
#include "wavetracer/device/path_vertex.h"

// A device need not compile code for things that the scene does not have.
#ifndef WT_LOSSES
#define WT_LOSSES 1
#endif

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

typedef struct {
  double delay_s, gain_db, doppler_hz;
  wt_angles departure, arrival;
  wt_double2 a[4];  // receiver's port 2 r + transmitter's port t
  int near_edge;    // wt_is_near_edge
} wt_path_field;

// Applies both ends' antennas to the matrix of the path, without the amplitude at 1 m.
inline void wt_port_coefficients(const wt_matrix* m, const wt_port_fields* sent, const wt_port_fields* heard,
                                 double at_1_m, wt_path_field* out) {
  double power = 0.0;
  for (int t = 0; t < 2; ++t) {
    const wt_field_pair s = sent->port[t];
    const wt_double2 theta = wt_times(m->m[0], s.theta) + wt_times(m->m[1], s.phi);
    const wt_double2 phi = wt_times(m->m[2], s.theta) + wt_times(m->m[3], s.phi);
    for (int r = 0; r < 2; ++r) {
      const wt_double2 a = wt_times(heard->port[r].theta, theta) + wt_times(heard->port[r].phi, phi);
      out->a[2 * r + t] = a * at_1_m;
      power += wt_norm(out->a[2 * r + t]);
    }
  }
  out->gain_db = 10.0 * wt_log10(power);
}

// A wave on its way along a path: the leg that it is on, what has happened to it, and the path so far.
typedef struct {
  wt_walk_leg leg;
  wt_transfer transfer;
  double spread, since_m, speed;
  double section_m;  // the length of the path, or of its part on this side of the tile or target that it scatters from
  wt_uint solved;    // the number of the path in the list of solved ones
} wt_wave;

// Goes past vertex k, without the vertex's effect on the wave. Returns the leg before it.
inline wt_walk_leg wt_pass(const wt_field_world* world, const wt_path* path, wt_uint k, wt_wave* wave) {
  const wt_walk_leg leg = wave->leg;
#if WT_LOSSES
  wt_rain_on(&world->air, &leg, &wave->transfer);
#endif
  wave->leg = wt_next_leg(world, path, k, &leg);
  wave->since_m += leg.length_m;
  wave->speed += wt_closing_speed_at(world, wt_step(path, k), wave->leg.from, leg.direction, wave->leg.direction);
  return leg;
}

// Goes from vertex k over reflections, transmissions and scattering to the next edge or the end, and returns it.
inline wt_uint wt_pass_surfaces(const wt_field_world* world, const wt_path* path, double length_m, wt_uint k,
                                wt_wave* wave) {
  for (; k < path->depth && wt_kind(path, k) != WT_STEP_DIFFRACTION; ++k) {
    const wt_uint step = wt_step(path, k);
    const wt_walk_leg leg = wt_pass(world, path, k, wave);
#if WT_CELLS
    if (wt_is_cell(world, step)) {
      const wt_uint cell = step & ~WT_STEP_KIND;
      const double side_m = world->area_of_tile[cell];
      wt_scatter_in_cell(world, cell, wave->solved, leg.direction, wave->leg.direction, &wave->transfer);
      wave->spread = 1.0 / (wt_distance_from_cell(wave->since_m, side_m) *
                            wt_distance_from_cell(length_m - wave->since_m, side_m));
      continue;
    }
#endif
#if WT_TARGETS
    if ((step & WT_STEP_KIND) == WT_STEP_TARGET) {
      wave->section_m = length_m - wave->since_m;
      const wt_wave_map point =
          wt_wave_of_point(world, path, k, leg.direction, wave->leg.direction, wave->since_m, length_m - wave->since_m);
      wt_map(&wave->transfer, point.from, point.to, point.matrix);
      wave->spread = 1.0 / (wave->since_m * (length_m - wave->since_m));
      continue;
    }
#endif
#if WT_SCATTERS
    if ((step & WT_STEP_KIND) == WT_STEP_SCATTERING) {
      wt_ulong mirrors = 0;
#if WT_SCATTERS > 1
      mirrors = wt_mirrors_around(path, k);
      wave->section_m = length_m - wave->since_m;
#endif
      wt_scatter_at(world, step & ~WT_STEP_KIND, mirrors, leg.direction, wave->leg.direction, &wave->transfer);
      wave->spread = 1.0 / (wave->since_m * (length_m - wave->since_m));
      continue;
    }
#endif
    const int mirrored = (step & WT_STEP_KIND) == WT_STEP_REFLECTION;
    wt_meet_surface(world, step, leg.direction, wave->leg.direction, mirrored ? wave->section_m : length_m,
                    &wave->transfer);
  }
  return k;
}

#if WT_DIFFRACTS > 1
// Goes past two edges, from the leg between them on, which ends at vertex k.
inline void wt_pass_two(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row, const wt_path* path,
                        wt_uint k, wt_edge* edges, wt_wave* wave) {
  const wt_shared_plane plane = wt_snap_to_shared_plane(world, edges);
  wt_transfer before = wave->transfer;
  wave->transfer = wt_transfer_from(wt_leaving(edges[0].frame.along, edges[0].k_out));
  wt_pass(world, path, k, wave);
  wt_diffract_at_two(world, ordered, row, path, edges, &plane, &wave->transfer, &before);
  wave->transfer = before;
}
#endif

#if WT_DIFFRACTS > 2
// Goes past three edges or more, at vertices k, k + 1, ..., from the leg after the first one on.
inline void wt_pass_chain(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row, const wt_path* path,
                          wt_uint k, wt_edge* edges, wt_uint count, wt_wave* wave) {
  wt_transfer before = wave->transfer;
  wt_chain chain;
  for (wt_uint i = 0; i < count; ++i) {
    wt_shared_plane plane;
    plane.sides = 0;
    if (i + 1 < count) plane = wt_snap_to_shared_plane(world, edges + i);
    if (i > 0) wt_pass(world, path, k + i, wave);
    wt_add_to_chain(world, ordered, row, path, edges, count, i, &plane, &wave->transfer, &chain);
    wave->transfer = wt_transfer_from(wt_leaving(edges[i].frame.along, edges[i].k_out));
  }
  wt_map(&before, chain.from, chain.to, chain.sum);
  wave->transfer = before;
}
#endif

#if WT_DIFFRACTS && WT_EDGES_BESIDE
// The vertex at the path's tile or target, or its depth if it has none.
inline wt_uint wt_vertex_of_point(const wt_path* path) {
  wt_uint k = 0;
  while (k < path->depth && !wt_begins_wave(wt_step(path, k))) ++k;
  return k;
}

// Goes over all vertices of a path over a tile or target, with an edge before it or after it or both: a wave of an edge
// has its own spreading, and the wave on the other side 1 / its length. point: the vertex at the tile or target.
inline void wt_pass_beside_point(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                                 const wt_path* path, double length_m, wt_uint point, wt_edge* edges, wt_uint count,
                                 wt_wave* wave) {
  double spread = 1.0;
  wt_uint k = 0;
  for (wt_uint i = 0; i < count; ++i) {
    const wt_edge_ends ends = wt_ends_of(world, path, edges + i, 1);
    const int turns = wt_turns_at_all(edges + i, 1);
    spread *= turns ? wt_edge_spreading(edges + i, 1) : 0.0;
    k = wt_pass_surfaces(world, path, length_m, k, wave);
    wt_pass(world, path, k++, wave);
    if (turns) wt_diffract_at(world, ordered, row, path, edges + i, &ends, &wave->transfer);
  }
  wt_pass_surfaces(world, path, length_m, k, wave);
  const double first_m = wt_section_length(path, 0, path->from);
  const int before = edges[0].at < point;
  const int after = edges[count - 1].at > point;
  wave->spread = spread / ((before ? 1.0 : first_m) * (after ? 1.0 : length_m - first_m));
}
#endif

#if WT_DIFFRACTS
// Goes over all vertices. A wave along an edge is lost: no single point diffracts it. Returns wt_is_near_edge.
inline int wt_pass_all(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row, const wt_path* path,
                       double length_m, wt_wave* wave) {
  wt_edge edges[WT_EDGE_ROOM];
  const wt_uint count = wt_edges_of(world, path, edges);
#if WT_EDGES_BESIDE
  const wt_uint point = wt_vertex_of_point(path);
  if (count > 0 && point < path->depth) {
    wt_pass_beside_point(world, ordered, row, path, length_m, point, edges, count, wave);
    return wt_is_near_edge(world, edges, count);
  }
#endif
  const wt_edge_ends ends = wt_ends_of(world, path, edges, count);
  const int turns = wt_turns_at_all(edges, count);
  if (count > 0) wave->spread = turns ? wt_edge_spreading(edges, count) : 0.0;
  const wt_uint k = wt_pass_surfaces(world, path, length_m, 0, wave);
  if (!turns) {
    for (wt_uint i = 0; i < count; ++i) wt_pass(world, path, k + i, wave);
  } else if (count > 0) {
    wt_pass(world, path, k, wave);
    if (count == 1) wt_diffract_at(world, ordered, row, path, edges, &ends, &wave->transfer);
#if WT_DIFFRACTS > 1
    if (count == 2) wt_pass_two(world, ordered, row, path, k + 1, edges, wave);
#endif
#if WT_DIFFRACTS > 2
    if (count > 2) wt_pass_chain(world, ordered, row, path, k, edges, count, wave);
#endif
  }
  wt_pass_surfaces(world, path, length_m, k + count, wave);
  return wt_is_near_edge(world, edges, count);
}
#endif

// The field of a path, with a delay of 0. solved: its number in the list of solved ones. ordered, row: the rows of its
// link decide on which side of a boundary an edge's wave is; a path without edges needs none.
inline wt_path_field wt_field_of_path(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row,
                                      const wt_path* path, wt_uint solved) {
  const WT_GLOBAL wt_field_end* tx = world->transmitters + path->transmitter;
  const WT_GLOBAL wt_field_end* rx = world->receivers + path->receiver;
  wt_path_field out;
  out.delay_s = 0.0;
  out.near_edge = 0;

  wt_wave wave;
  wave.leg = wt_first_leg(path);
  const wt_double3 departure = wave.leg.direction;
  const wt_basis departure_basis = wt_spherical_basis(departure);
  wave.transfer = wt_transfer_from(departure_basis);
  const double length_m = wt_path_length(path);
  wave.spread = 1.0 / length_m;
  wave.since_m = 0.0;
#if WT_SCATTERS > 1 || WT_TARGETS > 1
  wave.section_m = wt_section_length(path, 0, path->from);
#else
  wave.section_m = length_m;
#endif
  wave.solved = solved;
  wave.speed = wt_dot3(wt_vector(tx->velocity_m_s), departure);
#if WT_DIFFRACTS
  out.near_edge = wt_pass_all(world, ordered, row, path, length_m, &wave);
#else
  wt_pass_surfaces(world, path, length_m, 0, &wave);
#endif
#if WT_LOSSES
  wt_rain_on(&world->air, &wave.leg, &wave.transfer);
  const double loss_np = wt_path_loss_np(world, solved, length_m);
  if (loss_np > 0.0) wave.spread *= wt_exp(-loss_np);
#endif
  const wt_double3 arrival = -wave.leg.direction;
  const wt_basis arrival_basis = wt_spherical_basis(arrival);
  wave.speed += wt_dot3(wt_vector(rx->velocity_m_s), arrival);
  wt_matrix m = wt_seen_in(&wave.transfer, arrival_basis);
  for (int i = 0; i < 4; ++i) m.m[i] = m.m[i] * wave.spread;

  out.departure = wt_angles_of(departure);
  out.arrival = wt_angles_of(arrival);
  out.doppler_hz = wave.speed / world->wavelength_m + 0.0;  // adding zero gives 0, not -0, where all stands still
  const wt_port_fields sent =
      wt_antenna_fields(world->antennas + tx->antenna, world->samples, tx->rotation, departure, departure_basis);
  const wt_port_fields heard =
      wt_antenna_fields(world->antennas + rx->antenna, world->samples, rx->rotation, arrival, arrival_basis);
  wt_port_coefficients(&m, &sent, &heard, world->wavelength_m / (4.0 * WT_PI), &out);
  return out;
}

// The field of row `row` of the ordered rows. Neighbouring rows meet their surfaces together and then their edges.
inline wt_path_field wt_field_of(const wt_field_world* world, const wt_ordered_rows* ordered, wt_uint row) {
  const wt_path path = wt_path_of(ordered->list, ordered->rows[row]);
  wt_path_field out = wt_field_of_path(world, ordered, row, &path, ordered->rows[row] >> 1);
  out.delay_s = ordered->delays[row];
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
