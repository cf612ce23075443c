// SPDX-License-Identifier: Apache-2.0
// Wedge diffraction against closed forms (Sommerfeld's half plane, the knife edge, the conducting wedge), and the total
// field, which must be continuous, against explicit images.
#include "radio/utd.hpp"

#include <doctest/doctest.h>

#include <random>

#include "radio/constants.hpp"
#include "radio/corner.hpp"
#include "radio/fresnel.hpp"
#include "radio/material.hpp"
#include "radio/transition.hpp"
#include "radio/world.hpp"

using namespace wavetracer;
using test::at_azimuth;
using test::Complex;
using test::concrete_face;
using test::Corner;
using test::CVector;
using test::glass_face;
using test::radians;
using test::size;
using test::wavelength_m;

namespace {

using std::numbers::pi;
constexpr double k_per_m = 2 * pi / wavelength_m;

WedgeFace metal() { return {complex_permittivity(Material{"metal", 1, 0, 1e7, 0, 1, 100, 0.1}, 5.9e9), 0.1}; }

// The coefficients of a plane wave across the edge, of a conducting wedge: soft, hard, in sqrt(m). Both directions of
// the reference axes (E along z, H along z) turn round between (beta', phi') and (beta, phi): minus the coefficient.
std::array<Complex, 2> scalar(double exterior_rad, double in, double out, double rho, const LitSides& lit = {}) {
  const Corner corner{exterior_rad, {perfect_conductor, perfect_conductor}, wavelength_m};
  const Diffraction d = diffract(corner.frame(), corner.faces, -at_azimuth(1, in, 0), at_azimuth(1, out, 0), rho,
                                 wavelength_m, false, lit);
  return {-d.coefficient[0], -d.coefficient[3]};
}

// Total field of a plane wave at a conducting wedge, convex: incident, reflected at both faces, diffracted.
std::array<Complex, 2> plane_wave_total(double exterior_rad, double in, double out, double rho) {
  const std::array<double, 3> angles{out - in, out + in, 2 * exterior_rad - out - in};
  std::array<Complex, 3> wave;
  std::array<bool, 3> lit;
  for (size_t i = 0; i < 3; ++i) {
    lit[i] = std::abs(angles[i]) < pi;
    wave[i] = lit[i] ? std::polar(1.0, k_per_m * rho * std::cos(angles[i])) : Complex{0};
  }
  const auto [soft, hard] = scalar(exterior_rad, in, out, rho, {lit[0], {lit[1], lit[2]}});
  const Complex spreading = std::polar(1 / std::sqrt(rho), -k_per_m * rho);
  return {wave[0] - wave[1] - wave[2] + spreading * soft, wave[0] + wave[1] + wave[2] + spreading * hard};
}

// A. Sommerfeld, Math. Ann. 47, 1896.
std::array<Complex, 2> sommerfeld(double in, double out, double rho) {
  const auto part = [&](double angle) {
    const double root = std::sqrt(2 * k_per_m * rho) * std::cos(angle / 2);
    return std::polar(1 / std::sqrt(pi), pi / 4 + k_per_m * rho * std::cos(angle)) * test::fresnel_tail(-root);
  };
  return {part(out - in) - part(out + in), part(out - in) + part(out + in)};
}

}  // namespace

TEST_CASE("half plane: the total field is Sommerfeld's exact solution") {
  for (const double in : {60.0, 5.0, 130.0, 200.0, 359.0}) {
    for (double out = 1; out < 360; out += 7) {
      for (const double rho : {10 * wavelength_m, 0.3 * wavelength_m}) {
        CAPTURE(in);
        CAPTURE(out);
        const auto exact = sommerfeld(in * radians, out * radians, rho);
        const auto total = plane_wave_total(2 * pi, in * radians, out * radians, rho);
        CHECK(std::abs(total[0] - exact[0]) < 1e-9);
        CHECK(std::abs(total[1] - exact[1]) < 1e-9);
      }
    }
  }
}

TEST_CASE("half plane: known magnitudes, phi' = 60 degrees, 10 wavelengths away") {
  struct Known {
    double out, soft, hard;
  };
  for (const Known& k : {Known{90, 1.737037, 1.162385},
                         {150, .907037, 1.047370},
                         {240, .479781, .521055},
                         {270, .070455, .122478},
                         {300, .025138, .075460}}) {
    const auto [soft, hard] = plane_wave_total(2 * pi, 60 * radians, k.out * radians, 10 * wavelength_m);
    CAPTURE(k.out);
    CHECK(std::abs(std::abs(soft) - k.soft) < 6e-7);
    CHECK(std::abs(std::abs(hard) - k.hard) < 6e-7);
  }
}

TEST_CASE("90 degree wedge: the jump at the incident shadow boundary, 55 + 180 degrees") {
  const Corner corner{1.5 * pi, {perfect_conductor, perfect_conductor}, wavelength_m};
  for (const glm::dvec3 moment : {glm::dvec3{0, 0, 1}, {-std::sin(55 * radians), std::cos(55 * radians), 0}}) {
    const glm::dvec3 source = at_azimuth(10 * wavelength_m, 55 * radians, 0);
    const auto total = [&](double out_degrees) {
      const glm::dvec3 receiver = at_azimuth(10 * wavelength_m, out_degrees * radians, 0);
      return corner.geometrical(source, receiver, moment, 1) + corner.diffracted(source, receiver, moment);
    };
    const CVector before = total(235 - 1e-6), after = total(235 + 1e-6);
    CHECK(test::length(before - after) < 2e-7 / (20 * wavelength_m));
  }
}

// Soft and hard in equal parts are the incident terms alone, the black screen of knife-edge theory.
TEST_CASE("knife edge: the half plane has its loss near the shadow boundary") {
  const double distance = 5000, half = distance / 2 * distance / distance;
  const auto knife_edge_db = [](double nu) {
    return -20 * std::log10(std::abs(test::fresnel_tail(nu * std::sqrt(pi / 2))) / std::sqrt(pi));
  };
  const auto utd_db = [&](double nu) {
    const double height = nu * std::sqrt(wavelength_m * distance / 4);
    const double tilt = std::atan2(height, distance), in = pi / 2 - tilt, out = 3 * pi / 2 + tilt;
    const auto [soft, hard] = scalar(2 * pi, in, out, half);
    return -20 * std::log10(std::abs(soft + hard) / 2 / std::sqrt(half));
  };
  for (const auto& [nu, exact] :
       {std::pair{0.0, 6.02060}, {1.0, 13.86411}, {2.0, 19.09096}, {2.4, 20.61820}, {5.0, 26.93620}}) {
    CAPTURE(nu);
    CHECK(std::abs(knife_edge_db(nu) - exact) < 6e-6);
    CHECK(std::abs(utd_db(nu) - exact) < 0.001);
    const double itu_db = 6.9 + 20 * std::log10(std::sqrt((nu - 0.1) * (nu - 0.1) + 1) + nu - 0.1);
    CHECK(std::abs(utd_db(nu) - itu_db) < 0.13);
  }
}

TEST_CASE("conducting wedge, skew: Kouyoumjian and Pathak's scalars as printed, no coupling") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.02, 0.98);
  for (int i = 0; i < 500; ++i) {
    const double exterior = pi * (1 + part(random)), n = exterior / pi;
    const double beta0 = pi * part(random), length_m = 20 * part(random);
    const double in = exterior * part(random), out = exterior * part(random);
    const glm::dvec3 k_in{-std::sin(beta0) * std::cos(in), -std::sin(beta0) * std::sin(in), std::cos(beta0)};
    const glm::dvec3 k_out{std::sin(beta0) * std::cos(out), std::sin(beta0) * std::sin(out), std::cos(beta0)};
    const Corner corner{exterior, {perfect_conductor, perfect_conductor}, wavelength_m};
    const Diffraction d = diffract(corner.frame(), corner.faces, k_in, k_out, length_m, wavelength_m);
    const auto term = [&](double beta, double sign) {
      const double number = std::round((pi + sign * beta) / (2 * exterior));
      const double a = 2 * std::pow(std::cos((2 * exterior * number * sign - beta) / 2), 2);
      return transition(k_per_m * length_m * a) / std::tan((pi + sign * beta) / (2 * n));
    };
    const Complex front = -std::polar(1 / (2 * n * std::sqrt(2 * pi * k_per_m)), -pi / 4);
    const Complex incident = term(out - in, 1) + term(out - in, -1), mirrored = term(out + in, 1) + term(out + in, -1);
    const double scale = size(d.coefficient);
    CHECK(std::abs(d.coefficient[0] + front * (incident - mirrored)) < 1e-9 * scale);
    CHECK(std::abs(d.coefficient[3] + front * (incident + mirrored)) < 1e-9 * scale);
    CHECK(std::abs(d.coefficient[1]) + std::abs(d.coefficient[2]) < 1e-12 * scale);
  }
}

TEST_CASE("the total field is continuous at every shadow boundary, spherical waves") {
  double worst = 0;
  int boundaries = 0;
  const double step = 1e-9;
  for (const double interior : {10, 30, 60, 90, 120, 150, 170, 190, 225, 270, 300, 350}) {
    const double exterior = (360 - interior) * radians;
    const int order = exterior < pi ? static_cast<int>(std::ceil(pi / exterior)) + 1 : 1;
    const WedgeFace conductor = perfect_conductor;
    const std::pair<WedgeFace, WedgeFace> pairs[] = {{conductor, conductor},
                                                     {concrete_face(), concrete_face()},
                                                     {glass_face(), glass_face()},
                                                     {concrete_face(), metal()}};
    for (const auto& [face0, face1] : pairs) {
      for (const bool transmits : {false, true}) {
        if (transmits && exterior < pi) continue;
        const Corner corner{exterior, {face0, face1}, wavelength_m, transmits};
        for (const double height : {0.0, 7.0}) {
          for (const double part : {0.13, 0.41, 0.87}) {
            const glm::dvec3 source = at_azimuth(5, part * exterior, height);
            const auto lit = [&](double out) {  // tells which geometrical waves exist
              const glm::dvec3 receiver = at_azimuth(8, out, -2), moment{0.3, 0.5, 0.8};
              std::vector<bool> there;
              double unused;
              there.push_back(corner.passes(source, receiver, 0, unused) || corner.passes(source, receiver, 1, unused));
              for (size_t start : {0, 1})
                for (int count = 1; count <= order; ++count)
                  there.push_back(test::length(corner.reflected(source, receiver, moment, start, count)) > 0);
              return there;
            };
            const int grid = 400;
            for (int i = 0; i < grid; ++i) {
              double low = exterior * (i + 0.01) / grid, high = exterior * (i + 1.009) / grid;
              if (i == grid - 1) high = exterior * 0.9999;
              const auto left = lit(low);
              if (left == lit(high)) continue;
              while (high - low > step) {
                const double middle = (low + high) / 2;
                (lit(middle) == left ? low : high) = middle;
              }
              ++boundaries;
              for (const glm::dvec3 moment : {glm::dvec3{0, 0, 1}, glm::dvec3{0.6, 0.8, 0}}) {
                const auto total = [&](double out) {
                  const glm::dvec3 receiver = at_azimuth(8, out, -2);
                  return corner.geometrical(source, receiver, moment, order) +
                         corner.diffracted(source, receiver, moment);
                };
                const CVector difference = total(low - step) - total(high + step);
                const double jump = test::length(difference) * glm::length(source - at_azimuth(8, low, -2));
                worst = std::max(worst, jump);
                CAPTURE(interior);
                CAPTURE(low / radians);
                CAPTURE(part);
                CAPTURE(transmits);
                CHECK(jump < 1e-5);
              }
            }
          }
        }
      }
    }
  }
  MESSAGE(boundaries << " boundaries, largest jump of the total field " << worst << " of the free-space field");
  CHECK(boundaries > 500);
}
