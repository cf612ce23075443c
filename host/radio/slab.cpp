// SPDX-License-Identifier: Apache-2.0
// The same code as on devices: wavetracer/device/slab.h.
#include "radio/slab.hpp"

#include "wavetracer/device/slab.h"

namespace wavetracer {

SlabCoefficients slab_coefficients(std::complex<double> permittivity, double cos_theta, double thickness_m,
                                   double wavelength_m) {
  const device::wt_slab slab =
      device::wt_slab_coefficients({permittivity.real(), permittivity.imag()}, cos_theta, thickness_m, wavelength_m);
  const auto complex = [](const glm::dvec2& a) { return std::complex<double>{a.x, a.y}; };
  return {complex(slab.reflection_te), complex(slab.reflection_tm), complex(slab.transmission_te),
          complex(slab.transmission_tm)};
}

}  // namespace wavetracer
