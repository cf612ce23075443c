// SPDX-License-Identifier: Apache-2.0
// A plate: the closed form of its lobes, and the integral over it by quadrature where the far field does not hold.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>

#include "bodies/bodies.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;

namespace {

const double side_a = 6 * wave_m, side_b = 4 * wave_m;

Body plate() { return conductor({parallelogram({-side_a / 2, -side_b / 2, 0}, {side_a, 0, 0}, {0, side_b, 0})}); }

// sigma of physical optics, ends in the same direction (E. F. Knott et al., Radar Cross Section, chapter 5).
double plate_db(double theta_deg, double phi_deg) {
  const glm::dvec3 d = towards(theta_deg, phi_deg);
  const double k = 2 * pi / wave_m, area = side_a * side_b;
  return db(4 * pi * std::pow(area / wave_m * d.z * sinc(k * side_a * d.x) * sinc(k * side_b * d.y), 2));
}

// The field at a short dipole along `heard`, from one along `sent`, that currents 2 n x H radiate: a sum over small
// squares, in which distances and directions are those of each one.
std::complex<double> by_quadrature(glm::dvec3 tx, glm::dvec3 rx, glm::dvec3 sent, glm::dvec3 heard, int steps) {
  const double k = 2 * pi / wave_m, step_a = side_a / steps, step_b = side_b / steps;
  const glm::dvec3 normal(0, 0, 1);
  std::complex<double> sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const glm::dvec3 p((i + 0.5) * step_a - side_a / 2, (j + 0.5) * step_b - side_b / 2, 0);
      const double in_m = glm::length(p - tx), out_m = glm::length(rx - p);
      const glm::dvec3 in = (p - tx) / in_m, out = (rx - p) / out_m;
      const glm::dvec3 field = sent - in * glm::dot(in, sent);
      const glm::dvec3 current = 2.0 * glm::cross(normal, glm::cross(in, field));
      const glm::dvec3 radiated = out * glm::dot(out, current) - current;
      sum += std::polar(glm::dot(heard, radiated) / (in_m * out_m), -k * (in_m + out_m)) * step_a * step_b;
    }
  return sum * std::complex(0.0, k / (4 * pi));
}

}  // namespace

TEST_CASE("a plate at normal incidence has 4 pi A^2 / lambda^2, and its lobes down to -20 dB within 0.1 dB") {
  const double most = db(4 * pi * std::pow(side_a * side_b / wave_m, 2));
  CHECK(std::abs(cross_section_db(plate(), {0, 0, 1}, {0, 0, 1})[0] - most) < 1e-4);
  int lobes = 0;
  double worst = 0;
  for (double phi = 0; phi < 360; phi += 15)
    for (double theta = 0; theta < 60; theta += 0.5) {
      if (plate_db(theta, phi) < most - 20) continue;
      const glm::dvec3 d = towards(theta, phi);
      const auto found = cross_section_db(plate(), d, d);
      CHECK(std::abs(found[0] - plate_db(theta, phi)) < 0.1);
      CHECK(std::abs(found[3] - plate_db(theta, phi)) < 0.1);
      CHECK(found[1] < found[0] - 100);
      worst = std::max({worst, std::abs(found[0] - plate_db(theta, phi)), std::abs(found[3] - plate_db(theta, phi))});
      ++lobes;
    }
  CHECK(lobes > 100);
  MESSAGE(fmt::format("plate: largest error {:.4f} dB in {} directions", worst, lobes));
}

TEST_CASE("a plate is the same in two triangles, from behind, and behind a copy of itself") {
  const Polygon whole = plate().facets[0].corners;
  const Body halves = conductor({{whole[0], whole[1], whole[2]}, {whole[0], whole[2], whole[3]}});
  Body covered = plate();
  covered.facets.push_back(covered.facets[0]);
  for (glm::dvec3& p : covered.facets[1].corners) p.z -= 0.02;
  for (const double theta : {3.0, 17.0, 160.0}) {
    const glm::dvec3 d = towards(theta, 20);
    const double alone = cross_section_db(plate(), d, d)[0];
    CHECK(std::abs(cross_section_db(halves, d, d)[0] - alone) < 1e-6);
  }
  // At normal incidence from far away the copy is dark but for a rim that is narrower than one part in a million.
  const double alone = cross_section_db(plate(), {0, 0, 1}, {0, 0, 1})[0];
  CHECK(std::abs(cross_section_db(covered, {0, 0, 1}, {0, 0, 1}, {.max_bounces = 1})[0] - alone) < 1e-4);
}

TEST_CASE("near a plate, the field is that of quadrature") {
  // The far field of this plate begins at 2 (6 lambda)^2 / lambda = 72 lambda.
  const glm::dvec3 places[] = {{0.02, 0.01, 0.08}, {-0.05, 0.03, 0.15}, {0.1, -0.1, 0.12}, {0, 0, 0.3}};
  const PhysicalOptics fine{.max_bounces = 1, .phase_error_rad = 0.005, .amplitude_error = 0.02};
  double fine_error = 0, coarse_error = 0;
  for (const glm::dvec3 tx : places)
    for (const glm::dvec3 rx : places) {
      const auto echoes = scattered(plate(), tx, rx, wave_hz, fine);
      REQUIRE(echoes.size() == 1);
      const auto found = sum_of(echoes, wave_hz), coarse = sum_of(scattered(plate(), tx, rx, wave_hz), wave_hz);
      const auto sent = device::wt_spherical_basis(glm::normalize(-tx));
      const auto heard = device::wt_spherical_basis(glm::normalize(-rx));
      const std::complex<double> truth[4] = {
          by_quadrature(tx, rx, sent.first, heard.first, 400), by_quadrature(tx, rx, sent.second, heard.first, 400),
          by_quadrature(tx, rx, sent.first, heard.second, 400), by_quadrature(tx, rx, sent.second, heard.second, 400)};
      // The stated errors are shares of the integral of the field's size; 2 / (d1 d2) is its largest density.
      const double nearest = std::abs(tx.z * rx.z), most = side_a * side_b / wave_m / nearest;
      for (size_t i = 0; i < 4; ++i) {
        CHECK(std::abs(found[i] - truth[i]) < 0.005 * most);
        CHECK(std::abs(coarse[i] - truth[i]) < 0.15 * most);
        fine_error = std::max(fine_error, std::abs(found[i] - truth[i]) / most);
        coarse_error = std::max(coarse_error, std::abs(coarse[i] - truth[i]) / most);
      }
    }
  MESSAGE(fmt::format("near field: largest error {:.4f}, and {:.4f} with the allowed errors that are the default",
                      fine_error, coarse_error));
}

TEST_CASE("echoes of small parts sum up to the same, and have the delays of their parts") {
  const glm::dvec3 tx = towards(20, 0) * 30.0, rx = towards(25, 40) * 40.0;
  const auto whole = scattered(plate(), tx, rx, wave_hz),
             parts = scattered(plate(), tx, rx, wave_hz, {.echo_size_m = 0.01});
  CHECK(whole.size() == 1);
  CHECK(parts.size() > 20);
  const auto one = sum_of(whole, wave_hz), many = sum_of(parts, wave_hz);
  const double most = side_a * side_b / wave_m / (30 * 40);
  for (size_t i = 0; i < 4; ++i) CHECK(std::abs(one[i] - many[i]) < 1e-3 * most);
  for (const Echo& echo : parts)
    CHECK(echo.length_m == doctest::Approx(glm::length(echo.vertices[0] - tx) + glm::length(rx - echo.vertices[0])));
}

TEST_CASE("a plate of a dielectric has its reflection coefficient, with the layer that the wave meets first in front") {
  Body wall = plate();
  const BodyMaterial layers{{{5.0, -0.3}, 0.004}, {{2.5, -0.1}, 0.007}};
  wall.materials = {layers};
  const auto level = [](const SlabCoefficients& r) { return db(std::norm(r.reflection_te)); };
  const double metal = cross_section_db(plate(), {0, 0, 1}, {0, 0, 1})[0];
  const BodyMaterial turned{layers[1], layers[0]};
  CHECK(std::abs(cross_section_db(wall, {0, 0, 1}, {0, 0, 1})[0] - metal -
                 level(wall_coefficients(layers, 1, wave_m))) < 1e-3);
  CHECK(std::abs(cross_section_db(wall, {0, 0, -1}, {0, 0, -1})[0] - metal -
                 level(wall_coefficients(turned, 1, wave_m))) < 1e-3);
  // In the specular direction, the plane of incidence is x = 0: phi is TE and theta is TM.
  const glm::dvec3 from = towards(50, -90), to = towards(50, 90);
  const SlabCoefficients r = wall_coefficients(layers, std::cos(50 * pi / 180), wave_m);
  const auto bare = cross_section_db(plate(), from, to), covered = cross_section_db(wall, from, to);
  CHECK(std::abs(covered[0] - bare[0] - db(std::norm(r.reflection_tm))) < 1e-3);
  CHECK(std::abs(covered[3] - bare[3] - db(std::norm(r.reflection_te))) < 1e-3);
}

TEST_CASE("what physical optics cannot compute is refused with a remedy") {
  CHECK_THROWS_AS(scattered(plate(), {0, 0, 1e-8}, {0, 0, 1}, wave_hz), ConfigError);
  CHECK_THROWS_AS(scattered(plate(), {0, 0, 1}, {0, NAN, 1}, wave_hz), ConfigError);
  CHECK_THROWS_AS(scattered(plate(), {0, 0, 1}, {0, 0, 1}, -1), ConfigError);
  CHECK_THROWS_AS(scattered(plate(), {0, 0, 1}, {0, 0, 1}, wave_hz, {.max_bounces = 0}), ConfigError);
  CHECK_THROWS_AS(scattered(plate(), {0, 0, 1}, {0, 0, 1}, wave_hz, {.phase_error_rad = 0}), ConfigError);
  CHECK_NOTHROW(scattered(plate(), {side_a, 0, 0}, {0, 0, 1}, wave_hz));  // in the plane, beside the plate
}
