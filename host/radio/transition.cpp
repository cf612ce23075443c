// g(s) = sqrt(pi) exp(j pi / 4) erfcx(u) at u = exp(j pi / 4) s, erfcx(u) = exp(u^2) erfc(u) the scaled complement.
// Three expansions of it meet at s = 3 and s = 8, where their neighbours have all digits; most edges are far from their
// shadow boundaries, beyond 8, and there a few multiplications suffice.
#include "radio/transition.hpp"

#include <cmath>
#include <numbers>

namespace wavetracer {
namespace {

using Complex = std::complex<double>;

const Complex eighth_turn = std::polar(1.0, std::numbers::pi / 4);

// M. Abramowitz and I. Stegun, 7.1.6: exp(u^2) erf(u) = 2 / sqrt(pi) times the sum of 2^k u^(2k+1) / (2k+1)!!.
Complex scaled_complement_by_series(Complex u) {
  const Complex square = u * u;
  Complex term = u, sum = u;
  for (int k = 1; std::abs(term) > 1e-17 * std::abs(sum); ++k) {
    term *= 2.0 * square / (2.0 * k + 1);
    sum += term;
  }
  return std::exp(square) - 2 * std::numbers::inv_sqrtpi * sum;
}

// The library's quotient looks for infinities first, at several times the cost; there are none here.
Complex over(double real, Complex z) { return real / std::norm(z) * std::conj(z); }

// 7.1.14, from its tail: sqrt(pi) erfcx(u) = 1 / (u + (1/2) / (u + 1 / (u + (3/2) / (u + ...)))).
Complex scaled_complement_by_fraction(Complex u) {
  Complex value = u;
  for (int k = 60; k > 0; --k) value = u + over(0.5 * k, value);
  return over(std::numbers::inv_sqrtpi, value);
}

// 7.1.23: sqrt(pi) u erfcx(u) ~ 1 - 1 / (2 u^2) + 1 * 3 / (2 u^2)^2 - ...; u^2 = j s^2, so the terms shrink until the
// s^2-th, exp(-s^2) small.
Complex scaled_complement_far(Complex u, double s) {
  const double step = 1 / (2 * s * s);
  double real = 1, imag = 0, term = 1;  // each term is j / (2 s^2) times its odd number times the one before
  for (int k = 1; term > 1e-17; k += 8) {
    imag += term *= k * step;
    real -= term *= (k + 2) * step;
    imag -= term *= (k + 4) * step;
    real += term *= (k + 6) * step;
  }
  return Complex{real, imag} * over(std::numbers::inv_sqrtpi, u);
}

}  // namespace

Complex transition_over_root(double s) {
  if (s == 0) return eighth_turn / std::numbers::inv_sqrtpi;
  const Complex u = eighth_turn * s;
  const Complex erfcx = s < 3   ? scaled_complement_by_series(u)
                        : s < 8 ? scaled_complement_by_fraction(u)
                                : scaled_complement_far(u, s);
  return eighth_turn / std::numbers::inv_sqrtpi * erfcx;
}

}  // namespace wavetracer
