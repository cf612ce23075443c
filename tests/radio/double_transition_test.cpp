// SPDX-License-Identifier: Apache-2.0
// The transition function of two edges against its double integral, by Simpson's rule on turned axes.
#include "wavetracer/device/double_transition.h"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>

namespace {

using Complex = std::complex<double>;

Complex complex_of(const glm::dvec2& a) { return {a.x, a.y}; }

// (2j)^2 of the integral over u, v > 0, and of u and v times the integrand.
struct Integrals {
  Complex whole, u, v;
};

// With u = t exp(-j pi / 4) the integrand is exp(-t^2 - s^2 + 2 r t s - 2 exp(j pi / 4) (x t + y s)).
Integrals integrals(double x, double y, double r) {
  const Complex turn = std::polar(1.0, -M_PI / 4), slope = 2.0 * std::polar(1.0, M_PI / 4);
  constexpr int steps = 800;
  const double reach = 6 / std::sqrt(1 - std::abs(r)), size = reach / steps;
  const auto weight = [](int i) { return (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / 3; };
  Integrals out{};
  for (int i = 0; i <= steps; ++i)
    for (int k = 0; k <= steps; ++k) {
      const double t = i * size, s = k * size;
      const Complex at =
          weight(i) * weight(k) * std::exp(-t * t - s * s + 2 * r * t * s - slope * (x * t + y * s)) * size * size;
      out.whole += at;
      out.u += at * t * turn;
      out.v += at * s * turn;
    }
  const Complex front = -4.0 * turn * turn;
  return {front * out.whole, front * out.u, front * out.v};
}

}  // namespace

TEST_CASE("the transition function of two edges is its double integral, and its means are those of u and v") {
  for (const double x : {0.0, 0.03, 0.6, 2.5})
    for (const double y : {0.0, 0.2, 2.0})
      for (const double r : {-0.85, -0.5, 0.0, 0.3, 0.85}) {
        CAPTURE(x);
        CAPTURE(y);
        CAPTURE(r);
        const Integrals expected = integrals(x, y, r);
        const glm::dvec2 whole = wavetracer::device::wt_double_transition(x, y, r);
        CHECK(std::abs(complex_of(whole) / expected.whole - 1.0) < 3e-5);
        const auto means = wavetracer::device::wt_means_of(x, y, r, whole);
        CHECK(std::abs(complex_of(means.u) - expected.u / expected.whole) < 1e-3);
        CHECK(std::abs(complex_of(means.v) - expected.v / expected.whole) < 1e-3);
      }
}

TEST_CASE("the edges of a pair change places, and edges that do not couple are a product") {
  using wavetracer::device::wt_double_transition;
  using wavetracer::device::wt_transition_over_root;
  for (const double x : {0.0, 0.4, 3.0, 30.0, 1e3})
    for (const double y : {0.0, 1.7, 12.0, 500.0}) {
      CAPTURE(x);
      CAPTURE(y);
      for (const double r : {-0.9999, -0.4, 0.4, 0.9999})
        CHECK(std::abs(complex_of(wt_double_transition(x, y, r)) / complex_of(wt_double_transition(y, x, r)) - 1.0) <
              1e-12);
      const Complex product = complex_of(wt_transition_over_root(x)) * complex_of(wt_transition_over_root(y));
      CHECK(std::abs(complex_of(wt_double_transition(x, y, 0)) / product - 1.0) < 2e-5);
    }
}

TEST_CASE("far from both boundaries two terms of the series in r are left") {
  using wavetracer::device::wt_double_transition;
  // Either side of WT_FAR_EDGES, where the integral gives way to the series.
  for (const double x : {0.5, 2.0, 6.0, 20.0})
    for (const double r : {-0.95, -0.5, 0.5, 0.95}) {
      CAPTURE(x);
      CAPTURE(r);
      const double y = WT_FAR_EDGES / x;
      const Complex near = complex_of(wt_double_transition(x, y * (1 - 1e-9), r));
      const Complex far = complex_of(wt_double_transition(x, y * (1 + 1e-9), r));
      CHECK(std::abs(near / far - 1.0) < 3e-4);
    }
}
