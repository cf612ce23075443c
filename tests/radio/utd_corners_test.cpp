// SPDX-License-Identifier: Apache-2.0
// Corners (exterior angles below pi) and slight bends of conductors against the exact solution: series of Bessel
// functions (J. Bowman, T. Senior, P. Uslenghi, Electromagnetic and Acoustic Scattering by Simple Shapes, 1969, 6.2).
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "radio/corner.hpp"

using namespace wavetracer;
using test::at_azimuth;
using test::Complex;
using test::Corner;

namespace {

using std::numbers::pi;
constexpr double wave_m = 0.05, wavenumber = 2 * pi / wave_m;

struct SoftHard {
  Complex soft{0}, hard{0};
};

// A plane wave from azimuth `in`, of phase 0 at the edge; E along the edge (soft), H along it (hard).
SoftHard exact(double exterior_rad, double in, double out, double rho_m) {
  const double n = exterior_rad / pi, x = wavenumber * rho_m;
  SoftHard sum;
  for (int m = 0; m / n < x + 40 + 5 * std::cbrt(x); ++m) {
    const Complex wave = std::polar(std::cyl_bessel_j(m / n, x), m / n * pi / 2) * (m == 0 ? 1.0 : 2.0) * (2 / n);
    sum.soft += wave * (std::sin(m / n * in) * std::sin(m / n * out));
    sum.hard += wave * (std::cos(m / n * in) * std::cos(m / n * out));
  }
  return sum;
}

// All images, and what the edge diffracts.
SoftHard by_rays(double exterior_rad, double in, double out, double rho_m) {
  SoftHard sum;
  const auto add = [&](double turn, double sign) {
    if (!(std::abs(turn) < pi)) return;
    const Complex wave = std::polar(1.0, wavenumber * rho_m * std::cos(turn));
    sum.soft += sign * wave;
    sum.hard += wave;
  };
  for (int k = -40; k <= 40; ++k) {
    add(out - in - 2 * k * exterior_rad, 1);
    add(out + in - 2 * k * exterior_rad, -1);
  }
  const Corner corner{exterior_rad, {perfect_conductor, perfect_conductor}, wave_m};
  const Diffraction d =
      diffract(corner.frame(), corner.faces, -at_azimuth(1, in, 0), at_azimuth(1, out, 0), rho_m, wave_m);
  const Complex spreading = std::polar(1 / std::sqrt(rho_m), -wavenumber * rho_m);
  sum.soft -= d.coefficient[0] * spreading;
  sum.hard -= d.coefficient[3] * spreading;
  return sum;
}

// The largest difference of both over directions, of the incident wave.
double apart(double exterior_rad, double rho_m) {
  double worst = 0;
  for (const double in_part : {0.0311, 0.2037, 0.3719, 0.5043, 0.8117}) {
    for (int i = 1; i < 60; ++i) {
      const double in = in_part * exterior_rad, out = exterior_rad * (i + 0.0173) / 60;
      const SoftHard a = exact(exterior_rad, in, out, rho_m), b = by_rays(exterior_rad, in, out, rho_m);
      worst = std::max({worst, std::abs(a.soft - b.soft), std::abs(a.hard - b.hard)});
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("the series is a plane wave and its images where there is no edge, and in a right angle") {
  for (const double whole : {1, 2, 3}) CHECK(apart(pi / whole, 10 * wave_m) < 1e-9);
}

TEST_CASE("conducting corners and wedges have the exact field, the better the farther") {
  struct Known {
    double exterior_deg, most;  // at 10 wavelengths from the edge; without the edge's wave it is 1
  };
  for (const Known& k : {Known{179.99, 1e-5},
                         {179.7, 1e-4},
                         {175, 1e-3},
                         {160, 3e-3},
                         {150, 4e-3},
                         {120, 1e-2},
                         {100, 1e-2},
                         {80, 2e-2},
                         {70, 2e-2},
                         {50, 4e-2},
                         {180.3, 1e-4},
                         {185, 1e-3},
                         {270, 1e-2}}) {
    CAPTURE(k.exterior_deg);
    const double near = apart(k.exterior_deg * pi / 180, 10 * wave_m),
                 far = apart(k.exterior_deg * pi / 180, 40 * wave_m);
    MESSAGE(k.exterior_deg << " degrees: " << near << " at 10 wavelengths, " << far << " at 40");
    CHECK(near < k.most);
    CHECK(far < 0.6 * near);
  }
}

// Both boundaries of a slight bend lie within its angle; their terms all but cancel. Neither digits nor the field may
// be lost for any small bend.
TEST_CASE("slight bends tend to the plane, also between their boundaries, to the last digits") {
  const double in = 1.1, rho_m = 100 * wave_m;
  for (double bent = 1e-3; bent > 1e-10; bent /= 10) {
    for (const double sign : {1.0, -1.0}) {
      const double exterior = pi + sign * bent;
      for (const double part : {-30.0, -1.0, -0.5, -0.01, 0.01, 0.25, 0.5, 1.0, 1.5, 1.99, 2.01, 3.0, 40.0}) {
        const double out = pi - in + sign * part * bent;
        const SoftHard plane = exact(pi, in, out, rho_m), bend = by_rays(exterior, in, out, rho_m);
        CAPTURE(bent);
        CAPTURE(part);
        // In the middle of 2 k rho = 1257 the boundaries are sqrt(2 k L) = 35 times their angle apart.
        CHECK(std::abs(bend.soft - plane.soft) < 200 * bent + 1e-12);
        CHECK(std::abs(bend.hard - plane.hard) < 200 * bent + 1e-12);
      }
    }
  }
}

TEST_CASE(
    "the field of a corner of any material tends to that of the plane: bent by a microradian, the edge is faint") {
  const double rho_m = 100 * wave_m;
  for (const WedgeFace& face : {test::concrete_face(), test::glass_face(), perfect_conductor}) {
    for (const double in : {0.2, 1.0, 2.0}) {
      for (double out = 0.05; out < pi; out += 0.1) {
        const auto edge = [&](double exterior) {
          const Corner corner{exterior, {face, face}, wave_m};
          return test::size(
                     diffract(corner.frame(), corner.faces, -at_azimuth(1, in, 0), at_azimuth(1, out, 0), rho_m, wave_m)
                         .coefficient) /
                 std::sqrt(rho_m);
        };
        // At the boundaries it is half a wave. Next to grazing, where an image of two reflections begins, it is
        // largest.
        if (std::abs(in + out - pi) < 0.01) continue;
        for (const double bent : {1e-6, -1e-6}) CHECK(edge(pi + bent) < 3e-3);
      }
    }
  }
}
