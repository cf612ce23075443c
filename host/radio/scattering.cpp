// SPDX-License-Identifier: Apache-2.0
// The same code as on devices: wavetracer/device/scattering.h.
#include "radio/scattering.hpp"

#include "wavetracer/device/scattering.h"

namespace wavetracer {

double lobe_integral(uint32_t alpha, double cos_theta) { return device::wt_lobe_integral(alpha, cos_theta); }

double scattering_pattern(uint32_t alpha, double cos_in, double cos_out, double cos_psi) {
  return device::wt_scattering_pattern(alpha, cos_in, cos_out, cos_psi);
}

double strongest_pattern(uint32_t alpha) { return device::wt_scattering_pattern(alpha, 1.0, 1.0, 1.0); }

ScatteredWave scatter(const Material& material, std::complex<double> permittivity, double wavelength_m,
                      const glm::dvec3& k_in, const glm::dvec3& k_out, const glm::dvec3& normal, double area_m2,
                      uint64_t seed, uint32_t tile) {
  const device::wt_material record{.permittivity = {permittivity.real(), permittivity.imag()},
                                   .thickness_m = material.thickness_m,
                                   .scattering = material.scattering,
                                   .cross_polar = material.scattering_cross_polar,
                                   .lobe = static_cast<uint32_t>(material.scattering_lobe),
                                   .layers = 0};
  const device::wt_wave_map wave =
      device::wt_scatter(&record, device::wt_no_layers(), wavelength_m, k_in, k_out, normal, area_m2, seed, tile, 0);
  return {{wave.from.first, wave.from.second}, {wave.to.first, wave.to.second}, matrix_of(wave.matrix)};
}

}  // namespace wavetracer
