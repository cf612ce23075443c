// SPDX-License-Identifier: Apache-2.0
// The complex relative permittivity of a radio material at a frequency (ITU-R P.2040, equations 14 and 28 to 29).
// Time convention exp(+j 2 pi f t): a lossy material has a negative imaginary part.
#pragma once
#include <complex>
#include <span>
#include <string>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// eta = a f^b - j c f^d / (2 pi f eps0), f in GHz inside the powers; frequency_hz > 0.
// Throws ConfigError if the frequency lies outside the range that the material is known in. The material has no layers.
std::complex<double> complex_permittivity(const Material& material, double frequency_hz);

// Returns an empty text if all materials are known at the frequency; else a text that names those that are not, with
// their ranges and a remedy.
std::string range_problem(std::span<const Material> materials, double frequency_hz);

}  // namespace wavetracer
