// SPDX-License-Identifier: Apache-2.0
// The Fresnel integral by quadrature, independent of the transition function of the program.
// Assumes arguments of at most some hundreds: the step is fixed.
#pragma once
#include <cmath>
#include <complex>
#include <numbers>

namespace wavetracer::test {

// The integral of exp(-j t^2) from x to infinity. Along t = x + exp(-j pi / 4) u the integrand decays as exp(-u^2), and
// the derivatives at both ends that Simpson's rule leaves are below 1e-12 at this step.
inline std::complex<double> fresnel_tail(double x) {
  const std::complex<double> turn = std::polar(1.0, -std::numbers::pi / 4), j{0, 1};
  if (x < 0) return std::sqrt(std::numbers::pi) * turn - fresnel_tail(-x);
  const auto integrand = [&](double u) { return std::exp(-2.0 * j * x * turn * u - u * u); };
  constexpr int steps = 60000;
  constexpr double step = 6.5 / steps;
  std::complex<double> sum = integrand(0) + integrand(6.5);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * integrand(i * step);
  return turn * std::exp(-j * x * x) * sum * step / 3.0;
}

}  // namespace wavetracer::test
