// SPDX-License-Identifier: Apache-2.0
// A path in the world of a frame: the tables that describe what it meets, its legs, and the neighbouring rows. Vertices
// must lie in their surfaces to rounding error, and surface normals must have unit length.
#ifndef WAVETRACER_DEVICE_PATH_WORLD_H
#define WAVETRACER_DEVICE_PATH_WORLD_H
#include "wavetracer/device/field_records.h"
#include "wavetracer/device/path_rows.h"

// A device need not compile scattering vegetation for a scene without it.
#ifndef WT_CELLS
#define WT_CELLS 1
#endif

// 1: paths over targets have no reflection; 2: they may have some; 0: there are no targets.
#ifndef WT_TARGETS
#define WT_TARGETS 2
#endif

// 1: paths over tiles have no reflection; 2: they may have some; 3: and an edge beside the tile; 0: there are no tiles.
#ifndef WT_SCATTERS
#define WT_SCATTERS 3
#endif

// Not 0: a path over a tile or a target may have an edge before it or after it.
#define WT_EDGES_BESIDE (WT_TARGETS > 1 || WT_SCATTERS > 2)

// A device need not compile code for pieces of bodies where no target is one.
#ifndef WT_FACETS
#define WT_FACETS 1
#endif

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The world as fields see it; surfaces, wedges, tiles and instances have their numbers in the world and their places in
// the frame.
typedef struct {
  const WT_GLOBAL wt_exact_surface* surfaces;
  const WT_GLOBAL wt_uint* materials_of;  // material of each surface
  const WT_GLOBAL wt_material* materials;
  const WT_GLOBAL wt_wedge* wedges;
  const WT_GLOBAL wt_uint* surface_of_tile;  // for a cell of vegetation: see WT_CELL
  const WT_GLOBAL double* area_of_tile;      // m2; for a cell the side of a cube of its volume, m
  const WT_GLOBAL wt_exact_instance* instances;
  const WT_GLOBAL wt_field_end* transmitters;
  const WT_GLOBAL wt_field_end* receivers;
  const WT_GLOBAL wt_antenna* antennas;
  const WT_GLOBAL double* samples;  // samples of antennas' grids
  double wavelength_m;
  wt_ulong seed;
  wt_uint transmissions;                   // the most transmissions of a path
  wt_uint reflections;                     // the most reflections of a path
  wt_uint scatters;                        // not 0: mirrored waves lose the power that is scattered
  wt_uint foliage_count;                   // kinds of vegetation
  const WT_GLOBAL wt_foliage* foliages;    // one record for each kind
  const WT_GLOBAL double* lengths_inside;  // for solved paths, kind by kind (kernels/fields/vegetation.cl)
  wt_air air;
  const WT_GLOBAL wt_target_point* targets;  // points of targets, in the frame
  const WT_GLOBAL wt_target_law* laws;
  const WT_GLOBAL wt_target_lobe* lobes;
  const WT_GLOBAL wt_target_facet* facets;
} wt_field_world;

// The rows of a frame in their order, so that a row can look at its neighbours; a place may have no row (WT_NO_ROW).
typedef struct {
  const wt_path_list* list;
  const WT_GLOBAL wt_uint* rows;
  const WT_GLOBAL double* delays;
  wt_uint count;
} wt_ordered_rows;

// In a shorter leg the direction is rounding error of its ends, and the law of reflection gives a better one.
#define WT_SHORTEST_LEG_M 1e-6

inline wt_uint wt_number(const wt_path* path, wt_uint k) { return wt_step(path, k) & ~WT_STEP_KIND; }
inline wt_uint wt_kind(const wt_path* path, wt_uint k) { return wt_step(path, k) & WT_STEP_KIND; }

// Walks along a path: leg k goes from vertex k - 1 (or the transmitter) to vertex k (or the receiver).
typedef struct {
  wt_double3 from, direction;
  double length_m;
} wt_walk_leg;

inline wt_walk_leg wt_first_leg(const wt_path* path) {
  wt_walk_leg leg;
  leg.from = path->from;
  const wt_double3 along = (path->depth > 0 ? wt_vertex(path, 0) : path->to) - path->from;
  leg.length_m = wt_length3(along);
  leg.direction = leg.length_m > WT_SHORTEST_LEG_M ? along / leg.length_m : WT_DOUBLE3(0.0, 0.0, 0.0);
  return leg;
}

// The leg after vertex k. The direction of a leg without length follows from the law of reflection.
inline wt_walk_leg wt_next_leg(const wt_field_world* world, const wt_path* path, wt_uint k, const wt_walk_leg* before) {
  wt_walk_leg leg;
  leg.from = wt_vertex(path, k);
  const wt_double3 along = (k + 1 < path->depth ? wt_vertex(path, k + 1) : path->to) - leg.from;
  leg.length_m = wt_length3(along);
  if (leg.length_m > WT_SHORTEST_LEG_M) {
    leg.direction = along / leg.length_m;
  } else {
    leg.direction = before->direction;
    if (wt_kind(path, k) == WT_STEP_REFLECTION)
      leg.direction = wt_mirrored(leg.direction, wt_vector(world->surfaces[wt_number(path, k)].normal));
  }
  return leg;
}

// Antennas that touch a surface or each other have no such path, see host/radio/fields.hpp.
inline int wt_degenerates(const wt_field_world* world, const wt_path* path, wt_double3 end, wt_uint k) {
  if (wt_length3(end - wt_vertex(path, k)) <= WT_ON_SURFACE_M) return 1;
  if (wt_kind(path, k) != WT_STEP_REFLECTION) return 0;
  const WT_GLOBAL wt_exact_surface* surface = world->surfaces + wt_number(path, k);
  return fabs(wt_dot3(wt_vector(surface->normal), end) - surface->offset) <= WT_ON_SURFACE_M;
}
inline int wt_is_near(const wt_field_world* world, const wt_path* path) {
  if (path->depth == 0) return wt_length3(path->to - path->from) <= WT_ON_SURFACE_M;
  return wt_degenerates(world, path, path->from, 0) || wt_degenerates(world, path, path->to, path->depth - 1);
}

// Does a step end one wave and begin another, as tiles and targets do?
inline int wt_begins_wave(wt_uint step) {
  return (step & WT_STEP_KIND) == WT_STEP_SCATTERING || (step & WT_STEP_KIND) == WT_STEP_TARGET;
}

// Is the step at a cell of vegetation?
inline int wt_is_cell(const wt_field_world* world, wt_uint step) {
#if WT_CELLS
  return (step & WT_STEP_KIND) == WT_STEP_SCATTERING && (world->surface_of_tile[step & ~WT_STEP_KIND] & WT_CELL) != 0;
#else
  return 0;
#endif
}

// The instance on which a step happens, or WT_NONE.
inline wt_uint wt_step_instance(const wt_field_world* world, wt_uint step) {
  const wt_uint number = step & ~WT_STEP_KIND, kind = step & WT_STEP_KIND;
  if (wt_is_cell(world, step)) return WT_NONE;
#if WT_TARGETS
  if (kind == WT_STEP_TARGET) return world->targets[number].instance;
#endif
  if (kind == WT_STEP_DIFFRACTION) return world->wedges[number].instance;
  return world->surfaces[kind == WT_STEP_SCATTERING ? world->surface_of_tile[number] : number].instance;
}

// The number of a step's surface or wedge in its scene or model; for a tile, that of its surface; for a cell, that of
// its volume; for a point of a target, its number among the points of all targets.
inline wt_uint wt_local_number(const wt_field_world* world, wt_uint step) {
  const wt_uint number = step & ~WT_STEP_KIND, kind = step & WT_STEP_KIND;
#if WT_TARGETS
  if (kind == WT_STEP_TARGET) return number;
#endif
  if (wt_is_cell(world, step)) return world->surface_of_tile[number] & WT_CELL_NUMBER;
  const wt_uint instance = wt_step_instance(world, step);
  const wt_uint own = kind == WT_STEP_SCATTERING ? world->surface_of_tile[number] : number;
  if (instance == WT_NONE) return own;
  const WT_GLOBAL wt_exact_instance* body = world->instances + instance;
  return own - (kind == WT_STEP_DIFFRACTION ? body->first_wedge : body->first_surface);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
