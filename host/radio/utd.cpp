// SPDX-License-Identifier: Apache-2.0
// The same code as on devices: wavetracer/device/utd.h.
#include "radio/utd.hpp"

#include "wavetracer/device/utd.h"

namespace wavetracer {

Diffraction diffract(const WedgeFrame& wedge, const std::array<WedgeFace, 2>& faces, const glm::dvec3& k_in,
                     const glm::dvec3& k_out, double distance_m, double wavelength_m, bool transmits,
                     const LitSides& lit) {
  device::wt_wedge_face records[2];
  for (size_t face = 0; face < 2; ++face)
    records[face] = {{faces[face].permittivity.real(), faces[face].permittivity.imag()},
                     faces[face].thickness_m,
                     0.0,  // waves are plane
                     device::wt_no_layers()};
  const device::wt_wedge_frame frame{wedge.along, wedge.face, wedge.normal, wedge.exterior_rad};
  const device::wt_turn turn = device::wt_turn_at(&frame, k_in, k_out);
  device::wt_known_waves known = device::wt_nothing_known();
  for (size_t i = 0; i < WT_BOUNDARIES; ++i) {
    const int image = turn.boundaries[i].image;
    if (image < -1 || image > 1) continue;
    const std::optional<bool>& side = image == 0 ? lit.direct : lit.reflected[image > 0];
    if (side) known.lit[i] = *side;
  }
  const double plane_waves[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const device::wt_edge_ends ends = device::wt_without_ends();
  const device::wt_wave_map wave = device::wt_diffract(frame, records, k_in, k_out, &turn, plane_waves, distance_m,
                                                       wavelength_m, transmits, &known, &ends);
  return {{wave.from.first, wave.from.second}, {wave.to.first, wave.to.second}, matrix_of(wave.matrix)};
}

}  // namespace wavetracer
