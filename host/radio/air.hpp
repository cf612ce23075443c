// SPDX-License-Identifier: Apache-2.0
// Losses of waves in air per metre: rain (ITU-R P.838-3), fog (P.840-8), oxygen and water vapour (P.676-13, line by
// line). The weather is the same everywhere.
#pragma once
#include "wavetracer/config.hpp"
#include "wavetracer/device/field_records.h"

namespace wavetracer {

// k and alpha of rain for horizontal and vertical waves on level paths: k R^alpha dB/km, R in mm/h (P.838-3, equations
// 2 and 3; from 1 to 1000 GHz).
struct RainCoefficients {
  double k_h, k_v, alpha_h, alpha_v;
};
RainCoefficients rain_coefficients(double frequency_ghz);

// The loss in dB/km by oxygen, nitrogen and water vapour (P.676-13, Annex 1, equation 1; from 1 to 1000 GHz).
// pressure_hpa: that of dry air and water vapour together.
double gas_db_km(double frequency_ghz, double temperature_c, double pressure_hpa, double humidity_g_m3);

// The loss in dB/km by 1 g/m3 of droplets (P.840-8, equation 2; Rayleigh scattering, up to 200 GHz).
double fog_db_km(double frequency_ghz, double temperature_c);

// The losses in the form that fields read.
device::wt_air air_at(const AirConfig& air, double frequency_hz);

}  // namespace wavetracer
