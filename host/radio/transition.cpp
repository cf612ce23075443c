// g(s) = sqrt(pi) exp(j pi / 4) erfcx(u) at u = exp(j pi / 4) s, erfcx(u) = exp(u^2) erfc(u) the scaled complement.
// Two expansions of it meet at s = 3, where both have all their digits.
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

// 7.1.14, from its tail: sqrt(pi) erfcx(u) = 1 / (u + (1/2) / (u + 1 / (u + (3/2) / (u + ...)))).
Complex scaled_complement_by_fraction(Complex u) {
  Complex value = u;
  for (int k = 60; k > 0; --k) value = u + 0.5 * k / value;
  return std::numbers::inv_sqrtpi / value;
}

}  // namespace

Complex transition_over_root(double s) {
  if (s == 0) return eighth_turn / std::numbers::inv_sqrtpi;
  const Complex u = eighth_turn * s;
  const Complex erfcx = s < 3 ? scaled_complement_by_series(u) : scaled_complement_by_fraction(u);
  return eighth_turn / std::numbers::inv_sqrtpi * erfcx;
}

}  // namespace wavetracer
