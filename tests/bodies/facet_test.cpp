// SPDX-License-Identifier: Apache-2.0
// The integral of a linear phase over a triangle, and the field of a facet, against their definitions.
#include "wavetracer/device/facet.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <random>

#include "bodies/bodies.hpp"

using namespace wavetracer;

namespace {

using Complex = std::complex<double>;
Complex mean_of(double a, double b, double c) {
  const auto mean = device::wt_triangle_mean(a, b, c);
  return {mean.x, mean.y};
}

// The mean by a fine midpoint rule in extended precision: the error falls with the square of the steps.
Complex by_midpoints(double a, double b, double c, int steps) {
  std::complex<long double> sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2 * (steps - i) - 1; ++j) {
      const int up = j / 2;
      const long double third = j % 2 ? 2.0L / 3 : 1.0L / 3;
      const long double u = (i + third) / steps, v = (up + third) / steps;
      sum += std::polar(1.0L, static_cast<long double>(a) + u * (b - a) + v * (c - a));
    }
  return Complex(sum / static_cast<long double>(steps) / static_cast<long double>(steps));
}

}  // namespace

TEST_CASE("the mean of a linear phase over a triangle is that of quadrature") {
  std::mt19937_64 random(3);
  for (const double spread : {1e-9, 1e-3, 0.3, 0.999, 1.001, 3.0, 20.0})
    for (int i = 0; i < 5; ++i) {
      std::uniform_real_distribution<double> draw(-spread, spread);
      const double a = draw(random) + 100, b = draw(random) + 100, c = draw(random) + 100;
      CHECK(std::abs(mean_of(a, b, c) - by_midpoints(a, b, c, 400)) < 1e-5 * (0.01 + spread * spread));
    }
}

TEST_CASE("the mean over a triangle is that of its quarters, to the last digits, whatever is stationary") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> draw(-1, 1);
  for (const double spread : {0.0, 1e-12, 1e-6, 0.01, 0.5, 1.0, 2.0, 50.0, 1e4})
    for (const double second : {0.0, 1e-9, 1e-4, 1.0})  // the phase along an edge, beside that across it
      for (int i = 0; i < 20; ++i) {
        const double a = draw(random) * spread, b = a + second * draw(random) * spread, c = draw(random) * spread;
        const double ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
        const Complex quarters = mean_of(a, ab, ca) + mean_of(ab, b, bc) + mean_of(ca, bc, c) + mean_of(ab, bc, ca);
        CHECK(std::abs(mean_of(a, b, c) - quarters / 4.0) < 4e-16 * (4 + spread));
        CHECK(std::abs(mean_of(a, b, c) - mean_of(c, a, b)) < 4e-16 * (4 + spread));
      }
  CHECK(mean_of(0, 0, 0) == Complex(1));
}

TEST_CASE("the field of a conducting facet is that of twice the tangential magnetic field") {
  std::mt19937_64 random(9);
  std::normal_distribution<double> draw;
  const auto direction = [&] { return glm::normalize(glm::dvec3(draw(random), draw(random), draw(random))); };
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 normal = direction(), out = direction();
    glm::dvec3 in = direction();
    if (glm::dot(in, normal) > 0) in = -in;
    const auto from = device::wt_polarizations(in, normal), to = device::wt_spherical_basis(-out);
    const auto matrix = device::wt_facet_matrix(in, out, normal, {-1, 0}, {1, 0}, to);
    const glm::dvec3 sources[] = {from.first, from.second}, heard[] = {to.first, to.second};
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < 2; ++column) {
        const glm::dvec3 current = 2.0 * glm::cross(normal, glm::cross(in, sources[column]));
        const double expected = -glm::dot(heard[row], current - out * glm::dot(out, current));
        const auto found = matrix.m[2 * row + column];
        CHECK(std::abs(Complex(found.x, found.y) - expected) < 1e-14);
      }
  }
}

TEST_CASE("an empty facet, which reflects nothing, sends nothing back along the mirrored direction") {
  const glm::dvec3 normal(0, 0, 1), in = glm::normalize(glm::dvec3(0.3, -0.2, -1)),
                                    out = device::wt_mirrored(in, normal);
  const auto nothing = device::wt_facet_matrix(in, out, normal, {0, 0}, {0, 0}, device::wt_spherical_basis(-out));
  for (const auto value : nothing.m) CHECK(device::wt_size(value) < 1e-15);
  // Forwards it casts the shadow of an opaque sheet: minus the incident wave, whatever it reflects.
  const auto shadow =
      device::wt_facet_matrix(in, in, normal, {0.5, 0}, {0.2, 0.1}, device::wt_polarizations(in, normal));
  CHECK(std::abs(shadow.m[0].x - 2 * in.z) < 1e-14);
  CHECK(std::abs(shadow.m[3].x - 2 * in.z) < 1e-14);
}
