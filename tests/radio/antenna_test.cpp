// SPDX-License-Identifier: Apache-2.0
// Antennas against closed forms: gains, nulls, mean gain over the sphere, polarisation and orientation.
// Directions are global unit vectors away from the antenna.
#include "radio/antenna.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "radio/spherical.hpp"
#include "radio/world.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using test::World;

namespace {

using std::numbers::pi;

Antenna made(const std::string& antenna, Polarization polarization = "V",
             const std::array<double, 3>& orientation_deg = {0, 0, 0}) {
  return make_antenna(World::end({0, 0, 0}, antenna, polarization, orientation_deg));
}

double gain(const Antenna& antenna, const glm::dvec3& direction, uint32_t port = 0) {
  const FieldPair f = antenna.field(port, direction);
  return std::norm(f.theta) + std::norm(f.phi);
}

glm::dvec3 at(double theta_deg, double phi_deg) {
  const double t = theta_deg * pi / 180, p = phi_deg * pi / 180;
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

// Mean gain over the sphere: midpoint rule in theta, whose error falls with the square of the step.
double mean_gain(const Antenna& antenna) {
  constexpr int steps = 4000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double theta = (i + 0.5) * pi / steps;
    sum += gain(antenna, {std::sin(theta), 0, std::cos(theta)}) * std::sin(theta) / 2 * pi / steps;
  }
  return sum;
}

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
}

}  // namespace

TEST_CASE("isotropic: unit gain in every direction, however it is turned and polarised") {
  std::mt19937 random(1);
  for (const Polarization polarization : std::to_array<Polarization>({"V", "H", "VH", "cross"})) {
    const Antenna antenna = made("isotropic", polarization, {30, -50, 110});
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 d = i < 2 ? glm::dvec3{0, 0, i == 0 ? 1 : -1} : random_direction(random);
      for (uint32_t port = 0; port < antenna.ports(); ++port) {
        CHECK(gain(antenna, d, port) == test::near(1, 1e-14));
      }
    }
  }
}

TEST_CASE("dipoles: broadside gain, nulls on the axis, mean gain of a lossless antenna") {
  const Antenna short_dipole = made("short-dipole"), dipole = made("dipole");
  for (const double phi : {0.0, 77.0, 180.0, -90.0}) {
    CHECK(gain(short_dipole, at(90, phi)) == test::near(1.5, 1e-12));
    CHECK(gain(dipole, at(90, phi)) == test::near(1.6409, 1e-4));
  }
  for (const double end : {1.0, -1.0}) {
    CHECK(gain(short_dipole, {0, 0, end}) < 1e-30);
    CHECK(gain(dipole, {0, 0, end}) < 1e-30);
    // Close to the axis cos(pi/2 cos t) / sin t is pi t / 4.
    CHECK(std::sqrt(gain(dipole, glm::normalize(glm::dvec3{1e-7, 0, end})) / 1.6409223769845852) ==
          test::near(pi / 4 * 1e-7, 1e-6));
  }
  CHECK(gain(dipole, at(45, 10)) ==
        test::near(1.6409223769845852 * std::pow(std::cos(pi / 2 * std::sqrt(0.5)), 2) / 0.5, 1e-12));
  CHECK(mean_gain(made("isotropic")) == test::near(1, 1e-6));
  CHECK(mean_gain(short_dipole) == test::near(1, 1e-6));
  CHECK(mean_gain(dipole) == test::near(1, 1e-6));
}

TEST_CASE("TR 38.901 element: 8 dBi ahead, 3 dB at half the beam width, a floor of -30 dB") {
  const Antenna antenna = made("tr38901");
  const auto gain_db = [&](const glm::dvec3& d) { return 10 * std::log10(gain(antenna, d)); };
  CHECK(gain_db({1, 0, 0}) == test::near(8, 1e-12));
  CHECK(gain_db(at(90, 32.5)) == test::near(5, 1e-12));
  CHECK(gain_db(at(90, -32.5)) == test::near(5, 1e-12));
  CHECK(gain_db(at(57.5, 0)) == test::near(5, 1e-12));
  CHECK(gain_db(at(122.5, 32.5)) == test::near(2, 1e-12));
  CHECK(gain_db(at(90, 180)) == test::near(-22, 1e-12));
  CHECK(gain_db(at(5, 150)) == test::near(-22, 1e-12));
}

TEST_CASE("polarisation: ports, slants, and orthogonality") {
  const glm::dvec3 d = at(70, 25);
  CHECK(made("isotropic", "V").ports() == 1);
  CHECK(made("isotropic", "H").ports() == 1);
  const FieldPair v = made("isotropic", "V").field(0, d), h = made("isotropic", "H").field(0, d);
  CHECK(std::abs(v.theta - 1.0) + std::abs(v.phi) < 1e-15);
  CHECK(std::abs(h.theta) + std::abs(h.phi - 1.0) < 1e-15);

  const Antenna both = made("isotropic", "VH"), cross = made("isotropic", "cross");
  REQUIRE(both.ports() == 2);
  REQUIRE(cross.ports() == 2);
  CHECK(std::abs(both.field(0, d).theta - 1.0) < 1e-15);
  CHECK(std::abs(both.field(1, d).phi - 1.0) < 1e-15);
  CHECK(std::abs(cross.field(0, d).theta - std::sqrt(0.5)) < 1e-15);
  CHECK(std::abs(cross.field(0, d).phi - std::sqrt(0.5)) < 1e-15);
  CHECK(std::abs(cross.field(1, d).theta - std::sqrt(0.5)) < 1e-15);
  CHECK(std::abs(cross.field(1, d).phi + std::sqrt(0.5)) < 1e-15);
}

TEST_CASE("orientation: yaw turns left, a positive pitch looks down, roll tips the polarisation") {
  const auto gain_db = [](const Antenna& a, const glm::dvec3& d) { return 10 * std::log10(gain(a, d)); };
  CHECK(gain_db(made("tr38901", "V", {90, 0, 0}), {0, 1, 0}) == test::near(8, 1e-12));
  CHECK(gain_db(made("tr38901", "V", {0, 20, 0}), at(110, 0)) == test::near(8, 1e-12));
  CHECK(gain_db(made("tr38901", "V", {90, 20, 0}), at(110, 90)) == test::near(8, 1e-12));

  // Rolled by 90 degrees about its boresight x, theta-hat = -z becomes +y, which is phi-hat towards +x.
  const FieldPair rolled = made("isotropic", "V", {0, 0, 90}).field(0, {1, 0, 0});
  CHECK(std::abs(rolled.theta) < 1e-15);
  CHECK(std::abs(rolled.phi - 1.0) < 1e-15);

  // A dipole laid down along x: null there, and polarised along x broadside.
  const Antenna lying = made("dipole", "V", {0, 90, 0});
  CHECK(gain(lying, {1, 0, 0}) < 1e-30);
  CHECK(std::abs(lying.field(0, {0, 1, 0}).phi) == test::near(std::sqrt(1.6409223769845852), 1e-12));
}

TEST_CASE("the poles are well defined and angles keep to one side of the cut") {
  for (const double z : {1.0, -1.0}) {
    const SphericalBasis b = basis_of({0, 0, z});
    CHECK(b.theta == glm::dvec3{z, 0, 0});
    CHECK(b.phi == glm::dvec3{0, 1, 0});
    CHECK(angles_of({-0.0, -0.0, z}).phi_rad == 0);
  }
  CHECK(angles_of({-1, -0.0, 0}).phi_rad == pi);
  CHECK(angles_of({0, -1, 0}).phi_rad == test::near(-pi / 2, 1e-15));
  CHECK(angles_of({1e-10, 0, 1}).theta_rad == test::near(1e-10, 1e-12));
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 d = random_direction(random);
    const SphericalBasis b = basis_of(d);
    CHECK(glm::length(glm::cross(b.theta, b.phi) - d) < 1e-14);
  }
}

TEST_CASE("unknown antennas are refused by name") {
  CHECK_THROWS_AS(made("dipol"), ConfigError);
  CHECK_THROWS_AS(made(std::string(300, 'x')), ConfigError);  // no file has so long a name
}
