// SPDX-License-Identifier: Apache-2.0
// The effect of one vertex of a path on the wave: its coefficients, and its part of the Doppler shift. Diffractions are
// in path_edges.h. wt_pass_surfaces (path_field.h) walks over the vertices.
#ifndef WAVETRACER_DEVICE_PATH_VERTEX_H
#define WAVETRACER_DEVICE_PATH_VERTEX_H
#include "wavetracer/device/layers.h"
#include "wavetracer/device/path_world.h"
#include "wavetracer/device/scattering.h"
#include "wavetracer/device/slab.h"
#include "wavetracer/device/target.h"
#include "wavetracer/device/transfer.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// A surface that mirrors the wave or lets it pass.
inline void wt_meet_surface(const wt_field_world* world, wt_uint step, wt_double3 k_in, wt_double3 k_out, double path_m,
                            wt_transfer* transfer) {
  const wt_uint surface = step & ~WT_STEP_KIND;
  const wt_double3 normal = wt_vector(world->surfaces[surface].normal);
  const wt_material material = world->materials[world->materials_of[surface]];
  const int passes = (step & WT_STEP_KIND) == WT_STEP_TRANSMISSION;
  wt_double2 permittivity = WT_DOUBLE2(material.permittivity[0], material.permittivity[1]);
  wt_layers layers = wt_no_layers();
#if WT_LAYERS
  // Both sides transmit alike, so one of them gives the same bits for both.
  layers = wt_layers_of(world->materials, material.layers, !passes && wt_dot3(k_in, normal) > 0.0);
  permittivity = wt_met_permittivity(layers, permittivity);
#endif
  const double zone = wt_zone_cosine(path_m, world->wavelength_m);
  const double cosine = wt_cosine_of_zone(permittivity, fmin(fabs(wt_dot3(k_in, normal)), 1.0), zone);
  const wt_slab slab = wt_wall_coefficients(layers, permittivity, cosine, material.thickness_m, world->wavelength_m);
  if (passes) {
    wt_meet(transfer, k_in, k_out, normal, slab.transmission_te, slab.transmission_tm);
  } else {
    const double share = world->scatters ? wt_specular_share(&material) : 1.0;
    wt_meet(transfer, k_in, k_out, normal, slab.reflection_te * share, slab.reflection_tm * share);
  }
}

#if WT_CELLS
// solved: the number of the path in the list of solved ones.
inline void wt_scatter_in_cell(const wt_field_world* world, wt_uint tile, wt_uint solved, wt_double3 k_in,
                               wt_double3 k_out, wt_transfer* transfer) {
  const wt_uint kind = world->surface_of_tile[tile] >> WT_CELL_KIND_SHIFT & (WT_MOST_KINDS - 1u);
  const WT_GLOBAL wt_foliage* foliage = world->foliages + kind;
  const double side_m = world->area_of_tile[tile];
  const double extinction =
      wt_foliage_extinction(foliage, world->lengths_inside[(wt_ulong)solved * world->foliage_count + kind]);
  const wt_wave_map wave =
      wt_scatter_in_leaves(foliage, extinction, k_in, k_out, side_m * side_m * side_m, world->seed, tile);
  wt_map(transfer, wave.from, wave.to, wave.matrix);
}
#endif

#if WT_SCATTERS > 1
// A hash of the mirrors that a path meets on its way from vertex k to one of its ends; 0 without any.
inline wt_ulong wt_mirrors_beside(const wt_path* path, wt_uint k, int back) {
  wt_ulong hash = 0;
  for (wt_uint i = 1; back ? i <= k : k + i < path->depth; ++i) {
    const wt_uint step = wt_step(path, back ? k - i : k + i);
    if ((step & WT_STEP_KIND) == WT_STEP_REFLECTION) hash = wt_mixed(hash + 1 + (step & ~WT_STEP_KIND));
  }
  return hash;
}

// A hash of the mirrors on both sides of vertex k, the same for the reversed path. Paths over one tile by other mirrors
// meet it under other angles, so their phases have nothing to do with each other.
inline wt_ulong wt_mirrors_around(const wt_path* path, wt_uint k) {
  return wt_mirrors_beside(path, k, 1) + wt_mirrors_beside(path, k, 0);
}
#endif

#if WT_SCATTERS
// mirrors: see wt_random_phase.
inline void wt_scatter_at(const wt_field_world* world, wt_uint tile, wt_ulong mirrors, wt_double3 k_in,
                          wt_double3 k_out, wt_transfer* transfer) {
  const wt_uint surface = world->surface_of_tile[tile];
  const wt_material material = world->materials[world->materials_of[surface]];
  wt_layers layers = wt_no_layers();
#if WT_LAYERS
  layers =
      wt_layers_of(world->materials, material.layers, wt_dot3(k_in, wt_vector(world->surfaces[surface].normal)) > 0.0);
#endif
  const wt_wave_map wave =
      wt_scatter(&material, layers, world->wavelength_m, k_in, k_out, wt_vector(world->surfaces[surface].normal),
                 world->area_of_tile[tile], world->seed, tile, mirrors);
  wt_map(transfer, wave.from, wave.to, wave.matrix);
}
#endif

// dL/dt = sum over legs of k . (x'(i+1) - x'(i)): returns how much vertex p, on a body that moves, adds to the speed at
// which the path gets shorter. A vertex moves with the velocity v of the body there, and slides along its surface or
// edge besides. k_in - k_out is normal to a mirror or to an edge, so sliding does not change L (Fermat's principle) and
// x' = v is exact, also on a turning body. A scattering point is fixed to the body; the velocity of a target's point is
// that of this point. A transmission goes straight on,
// k_in = k_out, and adds nothing.
inline double wt_closing_speed_at(const wt_field_world* world, wt_uint step, wt_double3 p, wt_double3 k_in,
                                  wt_double3 k_out) {
#if WT_TARGETS
  if ((step & WT_STEP_KIND) == WT_STEP_TARGET)
    return wt_dot3(wt_vector(world->targets[step & ~WT_STEP_KIND].velocity), k_out - k_in);
#endif
  const wt_uint instance = wt_step_instance(world, step);
  if (instance == WT_NONE || (step & WT_STEP_KIND) == WT_STEP_TRANSMISSION) return 0.0;
  const WT_GLOBAL wt_exact_instance* body = world->instances + instance;
  const wt_double3 arm = p - wt_vector(body->position);
  const wt_double3 velocity = wt_vector(body->velocity) + wt_cross3(wt_vector(body->angular_velocity), arm);
  return wt_dot3(velocity, k_out - k_in);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
