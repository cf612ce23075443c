// SPDX-License-Identifier: Apache-2.0
// The transition function of the uniform theory of diffraction, with a relative error below 1e-14.
// The time convention is exp(+j 2 pi f t).
#pragma once
#include <cmath>
#include <complex>

namespace wavetracer {

// g(s) = 2j exp(j s^2) times the integral of exp(-j t^2) from s to infinity, s >= 0. It is sqrt(pi) exp(j pi / 4) at 0,
// and 1 / s for large s.
std::complex<double> transition_over_root(double s);

// F(x) = sqrt(x) g(sqrt x), x >= 0 (R. Kouyoumjian and P. Pathak, Proc. IEEE 62(11), 1974, eq. 27): 0 at a shadow
// boundary, 1 far from it.
inline std::complex<double> transition(double x) { return std::sqrt(x) * transition_over_root(std::sqrt(x)); }

}  // namespace wavetracer
