// The complex relative permittivity of a radio material at a frequency.
// Assumes that coefficients and range were validated where the material was made.
#include "radio/material.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "radio/constants.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

std::complex<double> complex_permittivity(const Material& material, double frequency_hz) {
  const double ghz = frequency_hz * 1e-9;
  if (!(ghz >= material.min_ghz && ghz <= material.max_ghz)) {
    throw ConfigError(
        fmt::format("radio.frequency_hz = {:g}: the material \"{}\" is only known from {:g} to {:g} GHz; choose a "
                    "frequency in that range, or give permittivity and conductivity_s_m in a [[material]] table with "
                    "name = \"{}\"",
                    frequency_hz, material.name, material.min_ghz, material.max_ghz, material.name));
  }
  const double permittivity = material.a * std::pow(ghz, material.b);
  const double conductivity_s_m = material.c * std::pow(ghz, material.d);
  return {permittivity, -conductivity_s_m / (2 * std::numbers::pi * frequency_hz * vacuum_permittivity_f_m)};
}

}  // namespace wavetracer
