// SPDX-License-Identifier: Apache-2.0
// Physical constants of the radio side, SI units.
// The speed of light is that in vacuum: delays are lengths divided by it.
#pragma once

namespace wavetracer {

inline constexpr double speed_of_light_m_s = 299792458.0;            // exact by definition of the metre
inline constexpr double vacuum_permittivity_f_m = 8.8541878128e-12;  // CODATA 2018

}  // namespace wavetracer
