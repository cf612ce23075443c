// SPDX-License-Identifier: Apache-2.0
// Losses of a wave in the air and in vegetation (host/radio/air.hpp, host/radio/vegetation_law.hpp), on legs of paths.
// Rain depends on the polarisation, since raindrops are flat: its two principal waves are the vertical and the
// horizontal one of every direction, and a leg is a diagonal matrix in them.
#ifndef WAVETRACER_DEVICE_LOSSES_H
#define WAVETRACER_DEVICE_LOSSES_H
#include "wavetracer/device/elementary.h"
#include "wavetracer/device/path_world.h"
#include "wavetracer/device/transfer.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The loss in Np/m of the vertical (cos 2 tau = -1) or horizontal (1) wave: k and alpha follow equations 4 and 5 of
// ITU-R P.838-3.
inline double wt_rain_np_m(const wt_air* air, double cos2_elevation, double cos_2tau) {
  const double c = cos2_elevation * cos_2tau;
  const double k = 0.5 * (air->rain_k[0] + air->rain_k[1] + (air->rain_k[0] - air->rain_k[1]) * c);
  const double k_alpha =
      0.5 * (air->rain_k_alpha[0] + air->rain_k_alpha[1] + (air->rain_k_alpha[0] - air->rain_k_alpha[1]) * c);
  return k * wt_exp(k_alpha / k * air->log_rain);
}

// Applies the loss of rain along a leg.
inline void wt_rain_on(const wt_air* air, const wt_walk_leg* leg, wt_transfer* transfer) {
  if (!air->rains || leg->length_m <= WT_SHORTEST_LEG_M) return;
  const double level = 1.0 - leg->direction.z * leg->direction.z;
  const wt_basis basis = wt_spherical_basis(leg->direction);
  const double vertical = wt_exp(-wt_rain_np_m(air, level, -1.0) * leg->length_m);
  const double horizontal = wt_exp(-wt_rain_np_m(air, level, 1.0) * leg->length_m);
  wt_map(transfer, basis, basis, wt_diagonal(wt_real(vertical), wt_real(horizontal)));
}

inline double wt_foliage_np(const WT_GLOBAL wt_foliage* foliage, double length_m) {
  const double loss = foliage->loss_np_m * length_m, most = foliage->most_np;
  return most > 0.0 ? -most * wt_expm1(-loss / most) : most == 0.0 ? 0.0 : loss;
}

// The share of the power that the next metre takes, for a path with this length inside.
inline double wt_foliage_extinction(const WT_GLOBAL wt_foliage* foliage, double length_m) {
  const double loss = foliage->loss_np_m, most = foliage->most_np;
  return 2.0 * (most > 0.0 ? loss * wt_exp(-loss * length_m / most) : most == 0.0 ? 0.0 : loss);
}

// The loss of a path in nepers by gases, fog and vegetation; solved: its number in the list of solved paths.
inline double wt_path_loss_np(const wt_field_world* world, wt_uint solved, double length_m) {
  double loss = world->air.loss_np_m * length_m;
  for (wt_uint kind = 0; kind < world->foliage_count; ++kind)
    loss +=
        wt_foliage_np(world->foliages + kind, world->lengths_inside[(wt_ulong)solved * world->foliage_count + kind]);
  return loss;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
