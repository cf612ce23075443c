// SPDX-License-Identifier: Apache-2.0
// Equations have the numbers of the recommendations; f is in GHz and attenuations are in dB/km, up to air_at.
// theta = 300 / T; e is the partial pressure of water vapour in hPa.
#include "radio/air.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "radio/gas_lines.hpp"

namespace wavetracer {
namespace {

constexpr double kelvin_at_0_c = 273.15;

// A term of P.838-3: sum of a exp(-((log f - b) / c)^2) + m log f + n.
struct RainTerm {
  double a, b, c;
};
double rain_curve(std::span<const RainTerm> terms, double m, double n, double log_f) {
  double out = m * log_f + n;
  for (const RainTerm& term : terms) out += term.a * std::exp(-std::pow((log_f - term.b) / term.c, 2));
  return out;
}

constexpr RainTerm k_h_terms[] = {{-5.33980, -0.10008, 1.13098},
                                  {-0.35351, 1.26970, 0.45400},
                                  {-0.23789, 0.86036, 0.15354},
                                  {-0.94158, 0.64552, 0.16817}};
constexpr RainTerm k_v_terms[] = {{-3.80595, 0.56934, 0.81061},
                                  {-3.44965, -0.22911, 0.51059},
                                  {-0.39902, 0.73042, 0.11899},
                                  {0.50167, 1.07319, 0.27195}};
constexpr RainTerm alpha_h_terms[] = {{-0.14318, 1.82442, -0.55187},
                                      {0.29591, 0.77564, 0.19822},
                                      {0.32177, 0.63773, 0.13164},
                                      {-5.37610, -0.96230, 1.47828},
                                      {16.1721, -3.29980, 3.43990}};
constexpr RainTerm alpha_v_terms[] = {{-0.07771, 2.33840, -0.76284},
                                      {0.56727, 0.95545, 0.54039},
                                      {-0.20238, 1.14520, 0.26809},
                                      {-48.2991, 0.791669, 0.116226},
                                      {48.5833, 0.791459, 0.116479}};

// P.676-13, equation 5: the shape of a line with width `width` and interference `mixing`.
double line_shape(double f, double f0, double width, double mixing) {
  const auto side = [&](double away) { return (width - mixing * away) / (away * away + width * width); };
  return f / f0 * (side(f0 - f) + side(f0 + f));
}

// The imaginary parts of the refractivity (P.676-13, equations 2 to 9).
double oxygen_refractivity(double f, double dry_hpa, double e, double theta) {
  double out = 0;
  for (const auto& [f0, a1, a2, a3, a4, a5, a6] : oxygen_lines) {
    const double strength = a1 * 1e-7 * dry_hpa * std::pow(theta, 3) * std::exp(a2 * (1 - theta));
    const double doppler_free = a3 * 1e-4 * (dry_hpa * std::pow(theta, 0.8 - a4) + 1.1 * e * theta);
    const double width = std::sqrt(doppler_free * doppler_free + 2.25e-6);
    const double mixing = (a5 + a6 * theta) * 1e-4 * (dry_hpa + e) * std::pow(theta, 0.8);
    out += strength * line_shape(f, f0, width, mixing);
  }
  const double d = 5.6e-4 * (dry_hpa + e) * std::pow(theta, 0.8);
  return out + f * dry_hpa * theta * theta *
                   (6.14e-5 / (d * (1 + std::pow(f / d, 2))) +
                    1.4e-12 * dry_hpa * std::pow(theta, 1.5) / (1 + 1.9e-5 * std::pow(f, 1.5)));
}

double water_refractivity(double f, double dry_hpa, double e, double theta) {
  double out = 0;
  for (const auto& [f0, b1, b2, b3, b4, b5, b6] : water_lines) {
    const double strength = b1 * 0.1 * e * std::pow(theta, 3.5) * std::exp(b2 * (1 - theta));
    const double pressure = b3 * 1e-4 * (dry_hpa * std::pow(theta, b4) + b5 * e * std::pow(theta, b6));
    const double width = 0.535 * pressure + std::sqrt(0.217 * pressure * pressure + 2.1316e-12 * f0 * f0 / theta);
    out += strength * line_shape(f, f0, width, 0);
  }
  return out;
}

}  // namespace

RainCoefficients rain_coefficients(double frequency_ghz) {
  const double log_f = std::log10(frequency_ghz);
  return {.k_h = std::pow(10, rain_curve(k_h_terms, -0.18961, 0.71147, log_f)),
          .k_v = std::pow(10, rain_curve(k_v_terms, -0.16398, 0.63297, log_f)),
          .alpha_h = rain_curve(alpha_h_terms, 0.67849, -1.95537, log_f),
          .alpha_v = rain_curve(alpha_v_terms, -0.053739, 0.83433, log_f)};
}

double gas_db_km(double frequency_ghz, double temperature_c, double pressure_hpa, double humidity_g_m3) {
  const double kelvin = temperature_c + kelvin_at_0_c, theta = 300 / kelvin;
  const double e = humidity_g_m3 * kelvin / 216.7, dry_hpa = std::max(pressure_hpa - e, 0.0);
  return 0.1820 * frequency_ghz *
         (oxygen_refractivity(frequency_ghz, dry_hpa, e, theta) + water_refractivity(frequency_ghz, dry_hpa, e, theta));
}

double fog_db_km(double frequency_ghz, double temperature_c) {
  const double f = frequency_ghz, off = 300 / (temperature_c + kelvin_at_0_c) - 1;
  const double e0 = 77.66 + 103.3 * off, e1 = 0.0671 * e0, e2 = 3.52;
  const double fp = 20.20 - 146 * off + 316 * off * off, fs = 39.8 * fp;
  const double in_p = 1 + std::pow(f / fp, 2), in_s = 1 + std::pow(f / fs, 2);
  const double real = (e0 - e1) / in_p + (e1 - e2) / in_s + e2;
  const double imaginary = f * (e0 - e1) / (fp * in_p) + f * (e1 - e2) / (fs * in_s);
  const double eta = (2 + real) / imaginary;
  return 0.819 * f / (imaginary * (1 + eta * eta));
}

device::wt_air air_at(const AirConfig& air, double frequency_hz) {
  const double ghz = frequency_hz / 1e9, np_m_of_db_km = std::numbers::ln10 / 20 / 1000;
  device::wt_air out{};
  double db_km = 0;
  if (air.gases) db_km += gas_db_km(ghz, air.temperature_c, air.pressure_hpa, air.humidity_g_m3);
  if (air.fog_g_m3 > 0) db_km += air.fog_g_m3 * fog_db_km(ghz, air.temperature_c);
  out.loss_np_m = db_km * np_m_of_db_km;
  if (air.rain_mm_h > 0) {
    const RainCoefficients rain = rain_coefficients(ghz);
    out.log_rain = std::log(air.rain_mm_h);
    out.rain_k[0] = rain.k_h * np_m_of_db_km;
    out.rain_k[1] = rain.k_v * np_m_of_db_km;
    out.rain_k_alpha[0] = out.rain_k[0] * rain.alpha_h;
    out.rain_k_alpha[1] = out.rain_k[1] * rain.alpha_v;
    out.rains = 1;
  }
  return out;
}

}  // namespace wavetracer
