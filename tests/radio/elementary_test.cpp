// SPDX-License-Identifier: Apache-2.0
// Our own elementary functions against the host's library in extended precision, whose 64 bits tell an error of a
// double's last place to a thousandth; complex ones against their definitions.
#include "wavetracer/device/elementary.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <limits>
#include <random>

#include "radio/spherical.hpp"
#include "wavetracer/device/complex.h"

using namespace wavetracer;

namespace {

// The distance of a double from a value in units of the value's last place as a double.
double ulps(double found, long double value) {
  const double rounded = static_cast<double>(value);
  if (found == rounded)
    return static_cast<double>(std::fabs(value - static_cast<long double>(found))) /
           (std::nextafter(std::fabs(rounded), INFINITY) - std::fabs(rounded));
  const double unit = std::nextafter(std::fabs(rounded), INFINITY) - std::fabs(rounded);
  return static_cast<double>(std::fabs(static_cast<long double>(found) - value) / static_cast<long double>(unit));
}

template <class Draw, class Ours, class Theirs>
double worst(int count, const Draw& draw, const Ours& ours, const Theirs& theirs) {
  std::mt19937_64 random(7);
  double most = 0;
  for (int i = 0; i < count; ++i) {
    const double x = draw(random);
    most = std::max(most, ulps(ours(x), theirs(static_cast<long double>(x))));
  }
  return most;
}

auto between(double low, double high) {
  return [low, high](std::mt19937_64& random) { return std::uniform_real_distribution(low, high)(random); };
}

// Returns a number of any size between two powers of two, of either sign.
auto of_any_size(int low, int high) {
  return [low, high](std::mt19937_64& random) {
    const double size = std::exp2(std::uniform_real_distribution<double>(low, high)(random));
    return random() % 2 ? size : -size;
  };
}

constexpr int many = 400'000;

}  // namespace

TEST_CASE("sine and cosine: within 0.9 of the last place, of every angle up to 2^44") {
  const auto sine = [](double x) { return device::wt_cos_sin(x).y; };
  const auto cosine = [](double x) { return device::wt_cos_sin(x).x; };
  for (const auto& [low, high] : {std::pair{-60, 0}, {0, 4}, {4, 20}, {20, 30}, {30, 38}, {38, 44}}) {
    CAPTURE(high);
    CHECK(worst(many, of_any_size(low, high), sine, [](long double x) { return std::sin(x); }) < 0.9);
    CHECK(worst(many, of_any_size(low, high), cosine, [](long double x) { return std::cos(x); }) < 0.9);
  }
  // The doubles nearest to multiples of a quarter turn, where the angle's digits cancel.
  for (int k = 1; k < 100'000; ++k) {
    const double x = k * 1.5707963267948966;
    REQUIRE(ulps(sine(x), std::sin(static_cast<long double>(x))) < 0.9);
    REQUIRE(ulps(cosine(x), std::cos(static_cast<long double>(x))) < 0.9);
  }
  CHECK(sine(0) == 0);
  CHECK(cosine(0) == 1);
}

TEST_CASE("exponential, logarithm and arc tangent: within a place and a half of the last") {
  CHECK(worst(many, between(-700, 700), device::wt_exp, [](long double x) { return std::exp(x); }) < 1);
  CHECK(worst(many, of_any_size(-60, -1), device::wt_exp, [](long double x) { return std::exp(x); }) < 1);
  CHECK(device::wt_exp(-1000) == 0);
  CHECK(device::wt_exp(710) == std::numeric_limits<double>::infinity());
  CHECK(device::wt_exp(0) == 1);
  CHECK(worst(many, of_any_size(-60, -2), device::wt_expm1, [](long double x) { return std::expm1(x); }) < 1);
  CHECK(worst(many, between(-40, 40), device::wt_expm1, [](long double x) { return std::expm1(x); }) < 3.5);
  const auto logarithm = [](long double x) { return std::log10(x); };
  CHECK(worst(many, between(1e-30, 1e-3), device::wt_log10, logarithm) < 1.5);
  CHECK(worst(many, between(0.5, 2), device::wt_log10, logarithm) < 2);
  CHECK(worst(many, between(1, 1e300), device::wt_log10, logarithm) < 1.5);
  CHECK(device::wt_log10(0) == -std::numeric_limits<double>::infinity());
  CHECK(device::wt_log10(1) == 0);
  CHECK(device::wt_log10(std::numeric_limits<double>::denorm_min()) == doctest::Approx(-323.30621534).epsilon(1e-10));
  CHECK(worst(
            many, of_any_size(-60, 60), [](double x) { return device::wt_atan2(x, 1); },
            [](long double x) { return std::atan(x); }) < 1);
}

TEST_CASE("arc tangent of two: all quadrants, axes, and signs of zero, within a place and a half of the last") {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  double most = 0;
  for (int i = 0; i < many; ++i) {
    const double y = normal(random), x = normal(random);
    most = std::max(most,
                    ulps(device::wt_atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
  }
  CHECK(most < 1.5);
  for (const double y : {0.0, -0.0, 1.0, -2.0})
    for (const double x : {0.0, -0.0, 1.0, -2.0}) {
      CAPTURE(y);
      CAPTURE(x);
      CHECK(device::wt_atan2(y, x) == doctest::Approx(std::atan2(y, x)).epsilon(1e-15));
      CHECK(std::signbit(device::wt_atan2(y, x)) == std::signbit(std::atan2(y, x)));
    }
}

TEST_CASE("complex roots, quotients and sizes: the host's to a few places, over the range of permittivities") {
  std::mt19937_64 random(5);
  const auto part = of_any_size(-40, 60);
  for (int i = 0; i < many; ++i) {
    const std::complex<double> a{part(random), part(random)}, b{part(random), part(random)};
    const auto ours = [](const glm::dvec2& c) { return std::complex<double>{c.x, c.y}; };
    const auto root = ours(device::wt_root({a.real(), a.imag()})), theirs = std::sqrt(a);
    REQUIRE(std::abs(root - theirs) <= 1e-15 * std::abs(theirs));
    const auto quotient = ours(device::wt_over({a.real(), a.imag()}, {b.real(), b.imag()}));
    REQUIRE(std::abs(quotient - a / b) <= 1e-15 * std::abs(a / b));
    REQUIRE(device::wt_size({a.real(), a.imag()}) == doctest::Approx(std::abs(a)).epsilon(1e-15).scale(0));
  }
  CHECK(device::wt_root({-4, 0}) == glm::dvec2{0, 2});
  CHECK(std::signbit(device::wt_root({-4, -0.0}).y));
  CHECK(device::wt_root({0, 0}) == glm::dvec2{0, 0});
}
