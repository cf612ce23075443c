// The same code as on devices: wavetracer/device/utd.h.
#include "radio/utd.hpp"

#include "wavetracer/device/utd.h"

namespace wavetracer {

Diffraction diffract(const WedgeFrame& wedge, const std::array<WedgeFace, 2>& faces, const glm::dvec3& k_in,
                     const glm::dvec3& k_out, double distance_m, double wavelength_m, bool transmits,
                     const LitSides& lit) {
  device::wt_wedge_face records[2];
  for (size_t face = 0; face < 2; ++face)
    records[face] = {{faces[face].permittivity.real(), faces[face].permittivity.imag()}, faces[face].thickness_m};
  const auto known = [](const std::optional<bool>& side) { return side ? static_cast<int>(*side) : -1; };
  const device::wt_wave_map wave = device::wt_diffract(
      {wedge.along, wedge.face, wedge.normal, wedge.exterior_rad}, records, k_in, k_out, distance_m, wavelength_m,
      transmits, {known(lit.direct), {known(lit.reflected[0]), known(lit.reflected[1])}});
  return {{wave.from.first, wave.from.second}, {wave.to.first, wave.to.second}, matrix_of(wave.matrix)};
}

}  // namespace wavetracer
