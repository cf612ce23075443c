// SPDX-License-Identifier: Apache-2.0
// Slab coefficients against Fresnel's formulas, P.2040's own form, conservation of energy and limits.
// Printed values were computed in double from the formula named beside them, to the digits shown.
#include "radio/slab.hpp"

#include <doctest/doctest.h>

#include "radio/material.hpp"
#include "radio/world.hpp"

using namespace wavetracer;
using test::infinity;
using test::radians;
using test::wavelength_m;
using Complex = std::complex<double>;

namespace {

bool finite(const SlabCoefficients& s) {
  for (const Complex c : {s.reflection_te, s.reflection_tm, s.transmission_te, s.transmission_tm}) {
    if (!std::isfinite(c.real()) || !std::isfinite(c.imag())) return false;
  }
  return true;
}

// P.2040-3 as printed is accurate where nothing cancels or overflows.
SlabCoefficients textbook(Complex eta, double theta, double thickness_m) {
  const Complex root = std::sqrt(eta - std::pow(std::sin(theta), 2)), j{0, 1};
  const Complex te = (std::cos(theta) - root) / (std::cos(theta) + root);
  const Complex tm = (eta * std::cos(theta) - root) / (eta * std::cos(theta) + root);
  const Complex q = 2 * std::numbers::pi * thickness_m / wavelength_m * root;
  const auto r = [&](Complex x) { return x * (1.0 - std::exp(-2.0 * j * q)) / (1.0 - x * x * std::exp(-2.0 * j * q)); };
  const auto t = [&](Complex x) { return (1.0 - x * x) * std::exp(-j * q) / (1.0 - x * x * std::exp(-2.0 * j * q)); };
  return {r(te), r(tm), t(te), t(tm)};
}

}  // namespace

TEST_CASE("half space: Fresnel magnitudes of concrete and ground at 5.9 GHz") {
  struct Known {
    double degrees, te, tm;
  };
  const Complex concrete = complex_permittivity(test::concrete(infinity), 5.9e9);
  for (const Known& k : {Known{0, .39404, .39404}, {45, .51178, .26192}, {60, .62005, .10896}, {80, .84589, .38850}}) {
    CAPTURE(k.degrees);
    const SlabCoefficients s = slab_coefficients(concrete, std::cos(k.degrees * radians), infinity, wavelength_m);
    CHECK(std::abs(std::abs(s.reflection_te) - k.te) < 6e-6);
    CHECK(std::abs(std::abs(s.reflection_tm) - k.tm) < 6e-6);
    CHECK(s.transmission_te == 0.0);
    CHECK(s.transmission_tm == 0.0);
  }
  const SlabCoefficients ground = slab_coefficients(complex_permittivity(test::medium_dry_ground(), 5.9e9),
                                                    std::cos(80 * radians), infinity, wavelength_m);
  CHECK(std::abs(std::abs(ground.reflection_te) - .90388) < 6e-6);
  CHECK(std::abs(std::abs(ground.reflection_tm) - .21952) < 6e-6);
}

TEST_CASE("slab at normal incidence: concrete of 0.1 m and glass of 10 mm") {
  const SlabCoefficients wall =
      slab_coefficients(complex_permittivity(test::concrete(0.1), 5.9e9), 1, 0.1, wavelength_m);
  CHECK(std::abs(std::abs(wall.reflection_te) - .378166) < 6e-7);
  CHECK(std::abs(std::abs(wall.transmission_te) - .186047) < 6e-7);
  CHECK(std::abs(wall.reflection_te + wall.reflection_tm) < 1e-15);
  CHECK(std::abs(wall.transmission_te - wall.transmission_tm) < 1e-15);

  const Material glass{"glass", 6.31, 0, 0.0036, 1.3394, 0.1, 100, 0.01};
  const SlabCoefficients pane = slab_coefficients(complex_permittivity(glass, 5.9e9), 1, 0.01, wavelength_m);
  CHECK(std::abs(std::abs(pane.reflection_te) - .046340) < 6e-7);
  CHECK(std::abs(std::abs(pane.transmission_te) - .958691) < 6e-7);
}

TEST_CASE("slab equals the printed form of P.2040 wherever that form is good") {
  for (const Complex eta : {Complex{5.24, -0.56}, {2.0, -0.01}, {7.07, -3.0}, {0.6, -0.2}}) {
    for (const double thickness_m : {0.001, 0.01, 0.1, 0.3}) {
      for (double degrees = 0; degrees < 89.5; degrees += 3) {
        CAPTURE(eta);
        CAPTURE(thickness_m);
        CAPTURE(degrees);
        const SlabCoefficients a = slab_coefficients(eta, std::cos(degrees * radians), thickness_m, wavelength_m);
        const SlabCoefficients b = textbook(eta, degrees * radians, thickness_m);
        CHECK(std::abs(a.reflection_te - b.reflection_te) < 1e-12);
        CHECK(std::abs(a.reflection_tm - b.reflection_tm) < 1e-12);
        CHECK(std::abs(a.transmission_te - b.transmission_te) < 1e-12);
        CHECK(std::abs(a.transmission_tm - b.transmission_tm) < 1e-12);
      }
    }
  }
}

TEST_CASE("energy: a lossless slab keeps all of it, a lossy one never adds any") {
  for (const double thickness_m : {0.0, 1e-6, 0.005, 0.0254, 0.1, 3.0}) {
    for (const double cos_theta : {1.0, 0.9, 0.5, 0.1, 1e-3, 1e-9, 1e-200, 0.0}) {
      CAPTURE(thickness_m);
      CAPTURE(cos_theta);
      for (const Complex eta : {Complex{4, 0}, {4, -0.0}, {2.5, 0}, {1, 0}, {0.5, 0}, {40, 0}}) {
        CAPTURE(eta);
        const SlabCoefficients s = slab_coefficients(eta, cos_theta, thickness_m, wavelength_m);
        CHECK(std::norm(s.reflection_te) + std::norm(s.transmission_te) == test::near(1, 1e-12));
        CHECK(std::norm(s.reflection_tm) + std::norm(s.transmission_tm) == test::near(1, 1e-12));
      }
      for (const Complex eta : {Complex{4, -0.1}, {5.24, -10}, {1, -3e7}, {1, -1e-6}}) {
        CAPTURE(eta);
        const SlabCoefficients s = slab_coefficients(eta, cos_theta, thickness_m, wavelength_m);
        CHECK(std::norm(s.reflection_te) + std::norm(s.transmission_te) <= 1 + 1e-12);
        CHECK(std::norm(s.reflection_tm) + std::norm(s.transmission_tm) <= 1 + 1e-12);
      }
    }
  }
}

TEST_CASE("a half-wave window is transparent, an empty slab only delays") {
  const double eta = 4, half_wave_m = wavelength_m / 2 / std::sqrt(eta);
  const SlabCoefficients window = slab_coefficients(eta, 1, half_wave_m, wavelength_m);
  CHECK(std::abs(window.reflection_te) < 1e-14);
  CHECK(std::abs(window.transmission_te + 1.0) < 1e-14);  // half a turn of phase

  const SlabCoefficients empty = slab_coefficients(1, 0.6, 0.25 * wavelength_m, wavelength_m);
  CHECK(empty.reflection_te == 0.0);
  CHECK(empty.reflection_tm == 0.0);
  CHECK(std::abs(empty.transmission_te - std::polar(1.0, -0.6 * std::numbers::pi / 2)) < 1e-14);
  CHECK(std::abs(empty.transmission_tm - empty.transmission_te) < 1e-15);
}

TEST_CASE("metal is finite at every angle and tends to a perfect conductor") {
  const Material metal{"metal", 1, 0, 1e7, 0, 1, 100, 0.1};
  const Complex eta = complex_permittivity(metal, 5.9e9);
  for (const double thickness_m : {1e-9, 1e-3, 0.1, 100.0, infinity}) {
    for (const double cos_theta : {1.0, 0.7, 1e-2, 1e-5, 1e-12, 1e-300, 0.0}) {
      CAPTURE(thickness_m);
      CAPTURE(cos_theta);
      CHECK(finite(slab_coefficients(eta, cos_theta, thickness_m, wavelength_m)));
    }
  }
  const SlabCoefficients s = slab_coefficients(eta, 0.7, 0.1, wavelength_m);
  CHECK(std::abs(s.reflection_te + 1.0) < 1e-3);  // surface impedance: 2 / sqrt|eta| = 3.6e-4
  CHECK(std::abs(s.reflection_tm - 1.0) < 1e-3);
  CHECK(std::abs(s.transmission_te) == 0);  // hundreds of thousands of nepers
}

TEST_CASE("grazing incidence tends to -1 smoothly, whatever the thickness") {
  const Complex eta = complex_permittivity(test::concrete(0.1), 5.9e9);
  for (const double thickness_m : {0.01, 0.1, infinity}) {
    CAPTURE(thickness_m);
    for (const double cos_theta : {1e-6, 1e-9, 1e-15, 0.0}) {
      CAPTURE(cos_theta);
      const SlabCoefficients s = slab_coefficients(eta, cos_theta, thickness_m, wavelength_m);
      CHECK(std::abs(s.reflection_te + 1.0) <= 20 * cos_theta + 1e-15);
      CHECK(std::abs(s.reflection_tm + 1.0) <= 20 * cos_theta + 1e-15);
    }
  }
}

TEST_CASE("a thick lossy slab is a half space") {
  const Complex eta{5.24, -0.56};
  for (const double cos_theta : {1.0, 0.5, 0.01}) {
    CAPTURE(cos_theta);
    const SlabCoefficients thick = slab_coefficients(eta, cos_theta, 10, wavelength_m);
    const SlabCoefficients half = slab_coefficients(eta, cos_theta, infinity, wavelength_m);
    CHECK(std::abs(thick.reflection_te - half.reflection_te) < 1e-14);
    CHECK(std::abs(thick.reflection_tm - half.reflection_tm) < 1e-14);
    CHECK(std::abs(thick.transmission_te) < 1e-50);
  }
}

TEST_CASE("extremes: finite, and no more power than comes in, for all that a material and a carrier may be") {
  for (const double relative : {1e-30, 1e-3, 1.0, 1.0 + 1e-15, 5.24, 1e6, 1e36})
    for (const double loss : {0.0, 1e-30, 1e-9, 1.0, 1e12, 1e22, 1e50})
      for (const double thickness_m :
           {1e-300, 1e-30, 1e-3, 0.1, 1e6, 5e6, 1e7, 1e9, 1e12, 1e14, 1e16, 1e20, 1e300, infinity})
        for (const double wave_m : {300.0, wavelength_m, 3e-4})
          for (const double cos_theta : {1.0, 0.6, 1e-3, 1e-12, 0.0}) {
            CAPTURE(relative);
            CAPTURE(loss);
            CAPTURE(thickness_m);
            CAPTURE(wave_m);
            CAPTURE(cos_theta);
            const SlabCoefficients s = slab_coefficients({relative, -loss}, cos_theta, thickness_m, wave_m);
            REQUIRE(finite(s));
            const double te = std::norm(s.reflection_te) + std::norm(s.transmission_te);
            const double tm = std::norm(s.reflection_tm) + std::norm(s.transmission_tm);
            REQUIRE(te <= 1 + 1e-8);  // if nearly nothing is there and grazed, 1 - cos^2 has lost half of its digits
            REQUIRE(tm <= 1 + 1e-8);
          }
}

TEST_CASE("a slab without loss keeps all power up to 2^44 rad of thickness, and is a half space from there on") {
  const double s = std::sqrt(5.24 - 0.75), rad_m = 2 * std::numbers::pi / wavelength_m * s;
  const SlabCoefficients half = slab_coefficients(5.24, 0.5, infinity, wavelength_m);
  for (const double log2_rad : {10.0, 29.9, 30.1, 31.5, 35.0, 43.9}) {
    CAPTURE(log2_rad);
    const SlabCoefficients slab = slab_coefficients(5.24, 0.5, std::exp2(log2_rad) / rad_m, wavelength_m);
    CHECK(std::norm(slab.reflection_te) + std::norm(slab.transmission_te) == test::near(1, 1e-12));
    CHECK(std::norm(slab.reflection_tm) + std::norm(slab.transmission_tm) == test::near(1, 1e-12));
  }
  for (const double log2_rad : {44.1, 60.0, 1000.0}) {
    CAPTURE(log2_rad);
    const SlabCoefficients slab = slab_coefficients(5.24, 0.5, std::exp2(log2_rad) / rad_m, wavelength_m);
    CHECK(slab.reflection_te == half.reflection_te);
    CHECK(slab.reflection_tm == half.reflection_tm);
    CHECK(slab.transmission_te == 0.0);
  }
}
