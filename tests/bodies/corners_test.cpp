// SPDX-License-Identifier: Apache-2.0
// Corners of conducting plates: waves that meet two and three of them, against closed forms.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bodies/bodies.hpp"

using namespace wavetracer;

namespace {

Body dihedral(double a, double b) {  // the edge is along z, the plates are in x = 0 and y = 0
  return conductor(
      {parallelogram({0, 0, -b / 2}, {a, 0, 0}, {0, 0, b}), parallelogram({0, 0, -b / 2}, {0, 0, b}, {0, a, 0})});
}

Body square_trihedral(double a) {
  return conductor({parallelogram({0, 0, 0}, {a, 0, 0}, {0, a, 0}), parallelogram({0, 0, 0}, {0, a, 0}, {0, 0, a}),
                    parallelogram({0, 0, 0}, {0, 0, a}, {a, 0, 0})});
}

Body triangular_trihedral(double a) {
  return conductor(
      {{{0, 0, 0}, {a, 0, 0}, {0, a, 0}}, {{0, 0, 0}, {0, a, 0}, {0, 0, a}}, {{0, 0, 0}, {0, 0, a}, {a, 0, 0}}});
}

size_t count_of(const std::vector<Echo>& echoes, size_t bounces) {
  size_t count = 0;
  for (const Echo& echo : echoes) count += echo.facets.size() == bounces;
  return count;
}

}  // namespace

TEST_CASE("a dihedral has 8 pi a^2 b^2 / lambda^2 on its axis, within 0.5 dB") {
  for (const double a : {10 * wave_m, 20.3 * wave_m}) {
    const double b = 15 * wave_m, most = db(8 * pi * a * a * b * b / (wave_m * wave_m));
    const glm::dvec3 axis = towards(90, 45);
    const auto found = cross_section_db(dihedral(a, b), axis, axis);
    CHECK(std::abs(found[0] - most) < 0.5);
    CHECK(std::abs(found[3] - most) < 0.5);
    MESSAGE(fmt::format("dihedral of {:.1f} wavelengths: {:+.2f} and {:+.2f} dB", a / wave_m, found[0] - most,
                        found[3] - most));
    const auto echoes = scattered(dihedral(a, b), axis * far_m, axis * far_m, wave_hz);
    CHECK(count_of(echoes, 1) == 2);
    CHECK(count_of(echoes, 2) == 2);
    CHECK(count_of(echoes, 3) == 0);
  }
}

TEST_CASE("off its axis, the double bounce of a dihedral keeps the area that both plates share") {
  // Between the axis and a plate, the width that bounces twice is 2 a sin of the smaller angle to a plate.
  const double a = 40 * wave_m, b = 15 * wave_m;
  for (const double phi : {20.0, 30.0, 40.0, 55.0, 65.0}) {
    const double width = 2 * a * std::sin(std::min(phi, 90 - phi) * pi / 180);
    const glm::dvec3 d = towards(90, phi);
    std::vector<Echo> twice;
    for (const Echo& echo : scattered(dihedral(a, b), d * far_m, d * far_m, wave_hz))
      if (echo.facets.size() == 2) twice.push_back(echo);
    const double found = db(4 * pi * std::norm(sum_of(twice, wave_hz)[0] * far_m * far_m));
    CHECK(std::abs(found - db(4 * pi * std::pow(width * b / wave_m, 2))) < 0.01);
  }
}

TEST_CASE("a dihedral turns the polarization of a wave that is slanted by 45 degrees") {
  // Two reflections leave the component along the edge and reverse the other one.
  const glm::dvec3 axis = towards(90, 45);
  const auto sum = sum_of(scattered(dihedral(0.1, 0.1), axis * far_m, axis * far_m, wave_hz), wave_hz);
  CHECK(std::abs(sum[0] + sum[3]) < 0.2 * std::abs(sum[0]));
  CHECK(std::abs(sum[1]) < 1e-6 * std::abs(sum[0]));
}

TEST_CASE("trihedrals have 12 pi a^4 / lambda^2 (squares) and 4 pi a^4 / (3 lambda^2) (triangles), within 0.5 dB") {
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1));
  for (const double a : {15 * wave_m, 24.7 * wave_m}) {
    const double a4 = a * a * a * a / (wave_m * wave_m);
    const auto square = cross_section_db(square_trihedral(a), axis, axis);
    const auto triangular = cross_section_db(triangular_trihedral(a), axis, axis);
    for (const size_t i : {0u, 3u}) {
      CHECK(std::abs(square[i] - db(12 * pi * a4)) < 0.5);
      CHECK(std::abs(triangular[i] - db(4 * pi * a4 / 3)) < 0.5);
      MESSAGE(fmt::format("trihedrals of {:.1f} wavelengths: {:+.2f} dB (squares), {:+.2f} dB (triangles)", a / wave_m,
                          square[i] - db(12 * pi * a4), triangular[i] - db(4 * pi * a4 / 3)));
    }
    const auto echoes = scattered(square_trihedral(a), axis * far_m, axis * far_m, wave_hz);
    CHECK(count_of(echoes, 3) >= 6);
  }
}

TEST_CASE("a trihedral sends back what comes within 20 degrees of its axis") {
  const Body body = triangular_trihedral(30 * wave_m);
  const double most = cross_section_db(body, glm::normalize(glm::dvec3(1)), glm::normalize(glm::dvec3(1)))[0];
  for (const double theta : {40.0, 54.7, 70.0})
    for (const double phi : {30.0, 45.0, 60.0}) {
      const glm::dvec3 d = towards(theta, phi);
      const double found = cross_section_db(body, d, d)[0];
      CHECK(found < most + 1);
      CHECK(found > most - 6);
    }
}

TEST_CASE("a bounce between plates is blocked by a plate between them") {
  Body body = dihedral(0.1, 0.1);
  const glm::dvec3 axis = towards(90, 45);
  // A sheet along the bisecting plane is in the way of all that bounces twice, and is seen edge-on.
  body.facets.push_back({parallelogram({0, 0, -0.05}, {0.1, 0.1, 0}, {0, 0, 0.1}), 0});
  CHECK(count_of(scattered(dihedral(0.1, 0.1), axis * far_m, axis * far_m, wave_hz), 2) == 2);
  for (const Echo& echo : scattered(body, axis * far_m, axis * far_m, wave_hz))
    if (echo.facets.size() == 2) CHECK((echo.facets[0] == 2 || echo.facets[1] == 2));
}
