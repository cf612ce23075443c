// SPDX-License-Identifier: Apache-2.0
// Waves of edges that end, against their integral and against Kirchhoff's integral over a quarter of a plane.
#include "wavetracer/device/edge_ends.h"

#include <doctest/doctest.h>

#include <cmath>
#include <complex>

using namespace wavetracer;

namespace {

using Complex = std::complex<double>;
const Complex eighth = std::polar(1.0, M_PI / 4);

Complex complex_of(const glm::dvec2& a) { return {a.x, a.y}; }

// exp(j x^2) times the integral from x on of s / (t^2 + s^2) exp(-j t^2), by Simpson's rule on t = x + exp(-j pi/4) y.
Complex integral_beyond(double s, double x) {
  constexpr int steps = 20000;
  const double size = 8.0 / steps;
  Complex sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double weight = (i == 0 || i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / 3;
    const Complex t = x + i * size / eighth;
    sum += weight * size / eighth * s / (t * t + s * s) * std::exp(-Complex(0, 1) * (t * t - x * x));
  }
  return sum * eighth / std::sqrt(M_PI);
}

wt_wedge edge(double length_m, uint32_t free_ends) {
  wt_wedge out{};
  out.length = length_m;
  out.free_ends = free_ends;
  return out;
}

// The wave of an edge whose line begins at `start` of the way's, with the phase of the shortest way.
Complex wave_of(double s, device::wt_way_over way, double start, const wt_wedge& wedge, double wavelength_m) {
  way.from -= start;
  way.to -= start;
  const double path_m = device::wt_length_at(&way, device::wt_shortest_at(&way));
  const device::wt_edge_ends ends = device::wt_ends_on(&wedge, &way, path_m, 1, wavelength_m);
  const glm::dvec2 g = device::wt_transition_over_root(s);
  return complex_of(device::wt_transition_between(s, g, &ends));
}

}  // namespace

TEST_CASE("the wave beyond a place of an edge is its integral, and at the shortest way half of the edge's") {
  for (const double s : {0.02, 0.3, 1.0, 4.0, 15.0}) {
    for (const double x : {0.05, 0.4, 2.0, 6.0}) {
      const Complex expected = integral_beyond(s, x);
      CHECK(std::abs(complex_of(device::wt_transition_beyond(s, x)) / expected - 1.0) < 5e-5);
    }
    const Complex half = complex_of(device::wt_transition_over_root(s)) / 2.0;
    CHECK(std::abs(complex_of(device::wt_transition_beyond(s, 0)) / half - 1.0) < 1e-4);
  }
  for (const double s : {5.999, 6.001, 8.0})  // on both sides of WT_FAR_POLE
    for (const double x : {0.0, 0.4, 1.5, 3.5}) {
      const Complex error = complex_of(device::wt_transition_beyond(s, x)) - integral_beyond(s, x);
      CHECK(std::abs(error) / (2 * std::sqrt(M_PI)) < 5e-5);
    }
  CHECK(device::wt_transition_beyond(0, 0.5) == glm::dvec2(0));
}

TEST_CASE("two parts of a cut edge diffract as the whole edge does, and nothing steps where the way leaves a part") {
  const wt_wedge part = edge(2, WT_FREE_START | WT_FREE_END), whole = edge(4, WT_FREE_START | WT_FREE_END);
  for (const double s : {0.1, 1.0, 5.0}) {
    Complex before = 0;
    for (int i = -40; i <= 40; ++i) {
      // The shortest way crosses the cut, at 2 m of the whole edge, and goes past both of its ends for |i| > 20.
      const double middle = 2 + 0.1 * i;
      const device::wt_way_over way{middle - 3, middle + 3, 10, 10};
      const Complex expected = wave_of(s, way, 0, whole, 0.3);
      const Complex sum = wave_of(s, way, 0, part, 0.3) + wave_of(s, way, 2, part, 0.3);
      CHECK(std::abs(sum - expected) < 1e-4);
    }
    for (const double at : {-1e-9, 1e-9}) {
      const Complex now = wave_of(s, {at - 3, at + 3, 10, 10}, 0, whole, 0.3);
      if (at > 0) CHECK(std::abs(now - before) < 1e-4);
      before = now;
    }
  }
}

TEST_CASE("both edges of a corner make up Kirchhoff's integral over a quarter of a plane") {
  // g / 2 sqrt(pi) exp(-j pi / 4) is the part of a wave beyond a straight edge, times the phase of the detour.
  const auto part = [](double x) {
    const Complex g = complex_of(device::wt_transition_of_any(x));
    return g / (2 * std::sqrt(M_PI)) / eighth * std::exp(Complex(0, -x * x));
  };
  const auto of_edge = [&](double s, double x) {  // the edge goes from x on; s: the distance, negative in the plane
    const Complex tail = complex_of(device::wt_transition_beyond(std::abs(s), std::abs(x)));
    const Complex g = complex_of(device::wt_transition_over_root(std::abs(s))) * std::exp(Complex(0, -s * s));
    const Complex beyond = tail * std::exp(Complex(0, -s * s - x * x));
    return (s < 0 ? -1.0 : 1.0) * (x < 0 ? g - beyond : beyond) / (2 * std::sqrt(M_PI)) / eighth;
  };
  for (const double y : {-1.4, -0.3, 0.01, 0.8})
    for (const double z : {-0.9, -0.02, 0.5, 2.0}) {
      const Complex expected = part(y) * part(z), sum = (y < 0 && z < 0 ? 1.0 : 0.0) + of_edge(y, z) + of_edge(z, y);
      CHECK(std::abs(sum - expected) < 1e-4);
    }
}
