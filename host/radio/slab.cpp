// SPDX-License-Identifier: Apache-2.0
// The same code as on devices: wavetracer/device/slab.h and layers.h.
#include "radio/slab.hpp"

#include <vector>

#include "wavetracer/device/layers.h"

namespace wavetracer {
namespace {

SlabCoefficients coefficients_of(const device::wt_slab& slab) {
  const auto complex = [](const glm::dvec2& a) { return std::complex<double>{a.x, a.y}; };
  return {complex(slab.reflection_te), complex(slab.reflection_tm), complex(slab.transmission_te),
          complex(slab.transmission_tm)};
}

}  // namespace

SlabCoefficients slab_coefficients(std::complex<double> permittivity, double cos_theta, double thickness_m,
                                   double wavelength_m) {
  return coefficients_of(
      device::wt_slab_coefficients({permittivity.real(), permittivity.imag()}, cos_theta, thickness_m, wavelength_m));
}

SlabCoefficients wall_coefficients(std::span<const WallLayer> layers, double cos_theta, double wavelength_m) {
  std::vector<device::wt_material> records;
  for (const WallLayer& layer : layers) {
    device::wt_material& record = records.emplace_back();
    record.permittivity[0] = layer.permittivity.real();
    record.permittivity[1] = layer.permittivity.imag();
    record.thickness_m = layer.thickness_m;
  }
  const device::wt_layers met = device::wt_layers_of(records.data(), static_cast<uint32_t>(records.size()), 0);
  return coefficients_of(device::wt_layer_coefficients(met, cos_theta, wavelength_m));
}

}  // namespace wavetracer
