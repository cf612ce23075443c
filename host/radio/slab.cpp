// Reflection and transmission of a single-layer slab, arranged so that no quotient loses its digits.
// Assumes the time convention exp(+j 2 pi f t), under which a wave that decays goes as exp(-j q) with Im q <= 0.
#include "radio/slab.hpp"

#include <cmath>
#include <numbers>

namespace wavetracer {
namespace {

using Complex = std::complex<double>;

// exp(z) - 1 without the cancellation at small z.
Complex complex_expm1(Complex z) {
  const double half_sine = std::sin(z.imag() / 2);
  return {std::expm1(z.real()) * std::cos(z.imag()) - 2 * half_sine * half_sine,
          std::exp(z.real()) * std::sin(z.imag())};
}

struct Polarized {
  Complex reflection, transmission;
};

// The wave inside the slab: s = sqrt(eta - sin^2 theta) is its normal wave number over that of free space.
struct Inside {
  Complex s;
  bool half_space;
  Complex one_pass;    // exp(-j q), q = 2 pi (d / lambda) s
  Complex round_trip;  // E = exp(-2 j q)
  Complex missing;     // (1 - E) / s, which stays finite where s vanishes
};

Inside inside(Complex permittivity, double cos_theta, double thickness_m, double wavelength_m) {
  Inside in;
  in.s = std::sqrt(permittivity - (1 - cos_theta * cos_theta));
  if (in.s.imag() > 0) in.s = -in.s;  // the branch that decays, also for a real eta below sin^2 theta
  in.half_space = std::isinf(thickness_m);
  if (in.half_space) return in;
  const double kd = 2 * std::numbers::pi * thickness_m / wavelength_m;
  const Complex exponent = Complex{0, -2 * kd} * in.s;
  in.one_pass = std::exp(exponent / 2.0);
  in.round_trip = std::exp(exponent);
  in.missing = in.s == 0.0 ? Complex{0, 2 * kd} : -complex_expm1(exponent) / in.s;
  return in;
}

// With r = (u - s) / (u + s), where u = cos theta (TE) or eta cos theta (TM), P.2040's
//   R = r (1 - E) / (1 - r^2 E),  T = (1 - r^2) exp(-j q) / (1 - r^2 E)
// multiplied out by (u + s)^2 / s. difference is u^2 - s^2, given in a form free of cancellation. u is not zero.
Polarized slab(const Inside& in, Complex u, Complex difference) {
  if (in.half_space) return {difference / ((u + in.s) * (u + in.s)), 0.0};
  const Complex denominator = (u * u + in.s * in.s) * in.missing + 2.0 * u * (1.0 + in.round_trip);
  return {difference * in.missing / denominator, 4.0 * u * in.one_pass / denominator};
}

}  // namespace

SlabCoefficients slab_coefficients(Complex permittivity, double cos_theta, double thickness_m, double wavelength_m) {
  const double c = cos_theta;
  const Complex contrast = permittivity - 1.0;
  if (c == 0) {  // the limit of grazing incidence, whatever the slab; an empty slab lets the wave pass
    const Complex reflection = contrast == 0.0 || thickness_m == 0 ? 0.0 : -1.0;
    return {reflection, reflection, 1.0 + reflection, 1.0 + reflection};
  }
  const Inside in = inside(permittivity, c, thickness_m, wavelength_m);
  const Polarized te = slab(in, c, -contrast);
  const Polarized tm = slab(in, permittivity * c, contrast * ((permittivity + 1.0) * c * c - 1.0));
  return {te.reflection, tm.reflection, te.transmission, tm.transmission};
}

}  // namespace wavetracer
