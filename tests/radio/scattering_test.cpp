// SPDX-License-Identifier: Apache-2.0
// Diffuse scattering against quadrature over the hemisphere and over a plate, and against its own reverse.
// Simpson's rule in the cosine of the polar angle, equal steps in azimuth: both converge fast for smooth lobes.
#include "radio/scattering.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "radio/material.hpp"
#include "radio/world.hpp"
#include "scene/tiles.hpp"
#include "wavetracer/device/scattering.h"

using namespace wavetracer;
using test::radians;
using test::wavelength_m;
using Complex = std::complex<double>;

namespace {

// Returns the remaining share of the amplitude of the mirrored wave.
double share_of(const Material& material) {
  device::wt_material record{};
  record.scattering = material.scattering;
  return device::wt_specular_share(&record);
}

using std::numbers::pi;
const glm::dvec3 up{0, 0, 1};

glm::dvec3 direction(double cos_theta, double phi) {
  const double sine = std::sqrt(1 - cos_theta * cos_theta);
  return {sine * std::cos(phi), sine * std::sin(phi), cos_theta};
}

// The integral of f(direction) over the upper hemisphere.
template <class F>
double hemisphere(const F& f, int steps = 200, int azimuths = 64) {
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
    for (int k = 0; k < azimuths; ++k)
      sum += weight * f(direction(static_cast<double>(i) / steps, 2 * pi * (k + 0.5) / azimuths));
  }
  return sum * 2 * pi / azimuths / (3 * steps);
}

Material rough(double s, double lobe, double cross_polar, Material material = test::conductor()) {
  material.scattering = s;
  material.scattering_lobe = lobe;
  material.scattering_cross_polar = cross_polar;
  return material;
}

ScatteredWave wave(const Material& material, const glm::dvec3& k_in, const glm::dvec3& k_out, uint64_t seed = 1,
                   uint32_t tile = 0, double area_m2 = 1) {
  return scatter(material, complex_permittivity(material, 5.9e9), wavelength_m, k_in, k_out, up, area_m2, seed, tile);
}

// E_out = dyad E_in, in scene axes.
using Dyad = std::array<std::array<Complex, 3>, 3>;
Dyad dyad(const ScatteredWave& w) {
  Dyad d{};
  for (size_t out = 0; out < 2; ++out)
    for (size_t in = 0; in < 2; ++in)
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          d[static_cast<size_t>(i)][static_cast<size_t>(k)] += w.matrix[2 * out + in] * w.to[out][i] * w.from[in][k];
  return d;
}

double power(const ScatteredWave& w, size_t in) { return std::norm(w.matrix[in]) + std::norm(w.matrix[2 + in]); }

}  // namespace

TEST_CASE("the closed form of F_alpha is the integral of its lobe") {
  for (const uint32_t alpha : {0u, 1u, 2u, 3u, 4u, 7u, 10u, 25u, 50u})
    for (const double degrees : {0.0, 20.0, 45.0, 70.0, 85.0, 90.0}) {
      CAPTURE(alpha);
      CAPTURE(degrees);
      const double c = std::cos(degrees * radians);
      const glm::dvec3 mirrored = direction(c, 0);
      const double sum =
          hemisphere([&](const glm::dvec3& k) { return std::pow((1 + glm::dot(mirrored, k)) / 2, alpha); }, 1000, 128);
      CHECK(lobe_integral(alpha, c) == test::near(sum, 1e-7));
    }
  // cos(theta) / F grows with cos(theta), which the smaller of both directions rests on.
  for (uint32_t alpha = 1; alpha <= 50; ++alpha)
    for (double c = 0.01; c <= 1; c += 0.01)
      CHECK(c / lobe_integral(alpha, c) > (c - 0.01) / lobe_integral(alpha, c - 0.01));
}

TEST_CASE("Lambert's law scatters all that arrives, a lobe the stated share of it and never more") {
  const auto share = [](uint32_t alpha, double degrees) {
    const double c = std::cos(degrees * radians);
    const glm::dvec3 mirrored = direction(c, 0);
    return hemisphere([&](const glm::dvec3& k) { return scattering_pattern(alpha, c, k.z, glm::dot(mirrored, k)); },
                      400, 128) /
           c;
  };
  for (const double degrees : {0.0, 45.0, 80.0, 89.0}) CHECK(share(0, degrees) == test::near(1, 1e-9));
  struct Known {
    uint32_t alpha;
    double at_0, at_45, at_60, at_80;
  };
  for (const Known& k : {Known{1, .622, .728, .800, .922},
                         {4, .769, .797, .820, .907},
                         {10, .849, .830, .825, .885},
                         {50, .962, .904, .864, .845}}) {
    CAPTURE(k.alpha);
    MESSAGE("a lobe of exponent " << k.alpha << " sends " << share(k.alpha, 0) << ", " << share(k.alpha, 45) << ", "
                                  << share(k.alpha, 60) << " and " << share(k.alpha, 80)
                                  << " of what is scattered at 0, 45, 60 and 80 degrees of incidence");
    CHECK(share(k.alpha, 0) == test::near(k.at_0, 2e-3));
    CHECK(share(k.alpha, 45) == test::near(k.at_45, 2e-3));
    CHECK(share(k.alpha, 60) == test::near(k.at_60, 2e-3));
    CHECK(share(k.alpha, 80) == test::near(k.at_80, 2e-3));
    for (double degrees = 0; degrees < 90; degrees += 7.5) CHECK(share(k.alpha, degrees) <= 1 + 1e-6);
    // Towards the mirrored direction it is the paper's.
    const double c = std::cos(50 * radians);
    CHECK(scattering_pattern(k.alpha, c, c, 1) == test::near(c / lobe_integral(k.alpha, c), 1e-14));
  }
}

TEST_CASE("a conductor scatters S^2 of the power, K of it in the other polarisation") {
  for (const double s : {0.0, 0.3, 1.0})
    for (const double k : {0.0, 0.2, 1.0}) {
      CAPTURE(s);
      CAPTURE(k);
      const Material material = rough(s, 0, k);
      const double c = std::cos(40 * radians);
      const glm::dvec3 k_in = -direction(c, pi);
      for (size_t in = 0; in < 2; ++in) {
        const auto part = [&](size_t row) {
          return hemisphere(
              [&](const glm::dvec3& out) { return std::norm(wave(material, k_in, out).matrix[2 * row + in]); }, 40, 16);
        };
        CHECK(part(in) == doctest::Approx(s * s * (1 - k) * c).epsilon(1e-9));
        CHECK(part(1 - in) == doctest::Approx(s * s * k * c).epsilon(1e-9));
      }
    }
  const Complex twice = wave(rough(0.5, 0, 0), -up, direction(0.6, 1), 1, 0, 2).matrix[0];
  CHECK(std::norm(twice) == test::near(2 * 0.25 * 0.6 / pi, 1e-6));  // area times S^2 cos / pi
  CHECK(share_of(rough(0, 0, 0)) == 1);
  CHECK(share_of(rough(0.6, 0, 0)) == test::near(0.8, 1e-15));
  CHECK(share_of(rough(1, 0, 0)) == 0);
}

TEST_CASE("a dielectric scatters about S^2 R^2, and S^2 R^2 exactly towards the mirrored direction") {
  const Material concrete = rough(1, 0, 0, test::concrete(test::infinity));
  const double te[] = {.39404, .51178, .62005, .84589}, tm[] = {.39404, .26192, .10896, .38850};
  const double degrees[] = {0, 45, 60, 80};
  const double te_shares[] = {1.386, 1.067, .881, .646}, tm_shares[] = {.659, .991, 2.383, .668};
  for (size_t i = 0; i < 4; ++i) {
    CAPTURE(degrees[i]);
    const double c = std::cos(degrees[i] * radians);
    const ScatteredWave w = wave(concrete, -direction(c, pi), direction(c, 0));
    CHECK(std::abs(w.matrix[0]) == test::near(te[i] * c / std::sqrt(pi), 2e-5));
    CHECK(std::abs(w.matrix[3]) == test::near(tm[i] * c / std::sqrt(pi), 1e-4));
    double shares[2];
    for (size_t in = 0; in < 2; ++in) {
      const double r = in == 0 ? te[i] : tm[i];
      const auto sent = [&](const glm::dvec3& k) { return power(wave(concrete, -direction(c, pi), k), in); };
      shares[in] = hemisphere(sent, 100, 8) / (c * r * r);
    }
    CHECK(shares[0] == test::near(te_shares[i], 5e-3));
    CHECK(shares[1] == test::near(tm_shares[i], 5e-3));
  }
}

TEST_CASE("reciprocal: the dyad of the way back is the transpose") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 400; ++i) {
    const Material material = rough(0.7, std::floor(6 * share(random)), share(random), test::concrete(0.1));
    // Every fifth straight down, every seventh straight up.
    const glm::dvec3 k_in = i % 5 == 0 ? -up : -direction(share(random), 6.28 * share(random));
    const glm::dvec3 k_out = i % 7 == 0 ? up : direction(share(random), 6.28 * share(random));
    const Dyad there = dyad(wave(material, k_in, k_out, 3, 11)), back = dyad(wave(material, -k_out, -k_in, 3, 11));
    for (size_t a = 0; a < 3; ++a)
      for (size_t b = 0; b < 3; ++b) CHECK(std::abs(there[a][b] - back[b][a]) < 1e-14);
    const ScatteredWave w = wave(material, k_in, k_out);
    CHECK(std::abs(glm::dot(w.from[0], w.from[1])) + std::abs(glm::dot(w.to[0], w.to[1])) < 1e-15);
    for (size_t k = 0; k < 2; ++k) {
      CHECK(std::abs(glm::dot(w.from[k], k_in)) < 1e-15);
      CHECK(std::abs(glm::dot(w.to[k], k_out)) < 1e-15);
    }
  }
}

TEST_CASE("phases: the same for the same seed and tile, uniform and unrelated otherwise") {
  const Material material = rough(1, 0, 0.5);
  const glm::dvec3 k_in = -direction(0.8, 0.3), k_out = direction(0.6, 2);
  CHECK(wave(material, k_in, k_out, 5, 17).matrix == wave(material, k_in, k_out, 5, 17).matrix);
  CHECK(wave(material, k_in, k_out, 5, 17).matrix != wave(material, k_in, k_out, 5, 18).matrix);
  CHECK(wave(material, k_in, k_out, 5, 17).matrix != wave(material, k_in, k_out, 6, 17).matrix);
  constexpr uint32_t tiles = 20000;
  Complex mean[3]{}, square[3]{}, between[3]{}, neighbours[3]{}, seeds[3]{}, before[3]{};
  for (uint32_t tile = 0; tile < tiles; ++tile) {
    const Matrix2 m = wave(material, k_in, k_out, 5, tile).matrix, other = wave(material, k_in, k_out, 6, tile).matrix;
    const auto unit = [](Complex z) { return z / std::abs(z); };
    const Complex phase[3]{unit(m[0]), unit(m[1]), unit(m[3])};
    const Complex phase6[3]{unit(other[0]), unit(other[1]), unit(other[3])};
    for (size_t k = 0; k < 3; ++k) {
      mean[k] += phase[k];
      square[k] += phase[k] * phase[k];
      between[k] += phase[k] * std::conj(phase[(k + 1) % 3]);
      neighbours[k] += phase[k] * std::conj(before[k]);
      seeds[k] += phase[k] * std::conj(phase6[k]);
      before[k] = phase[k];
    }
    CHECK(unit(m[2]) == -phase[1]);
  }
  // The mean of so many unit vectors is below 4 / sqrt(tiles) but once in 10^7.
  for (size_t k = 0; k < 3; ++k)
    for (const Complex sum : {mean[k], square[k], between[k], neighbours[k], seeds[k]})
      CHECK(std::abs(sum) < 4 * std::sqrt(static_cast<double>(tiles)));
}

TEST_CASE("the power of a plate's tiles converges to the integral over it, to second order") {
  const double side_m = 16;
  const glm::dvec3 tx{-5 + 8, -2 + 8, 6}, rx{4 + 8, 3 + 8, 8};
  Scene scene;
  scene.vertices = {{0, 0, 0}, {side_m, 0, 0}, {side_m, side_m, 0}, {0, side_m, 0}};
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.surface_triangles = {0, 1};
  for (const double lobe : {0.0, 4.0}) {
    CAPTURE(lobe);
    const Material material = rough(0.5, lobe, 0.1);
    scene.materials = {material};
    scene.surfaces = {{.normal = up, .triangle_count = 2}};
    // An unpolarised wave of unit power per solid angle arrives at a unit area at rx; the integrand is written out
    // again.
    const auto integrand = [&](const glm::dvec3& p) {
      const glm::dvec3 a = tx - p, b = rx - p;
      const double ra = glm::length(a), rb = glm::length(b), cos_a = a.z / ra, cos_b = b.z / rb;
      double pattern = cos_a * cos_b / pi;
      if (lobe > 0) {
        const glm::dvec3 mirrored{-a.x / ra, -a.y / ra, a.z / ra};
        const double g = std::pow((1 + glm::dot(mirrored, b / rb)) / 2, lobe);
        pattern = g * std::min(cos_a / lobe_integral(4, cos_a), cos_b / lobe_integral(4, cos_b));
      }
      return 0.25 * pattern / (ra * ra * rb * rb);
    };
    constexpr int steps = 800;
    double exact = 0;
    for (int i = 0; i < steps; ++i)
      for (int k = 0; k < steps; ++k) exact += integrand({side_m * (i + 0.5) / steps, side_m * (k + 0.5) / steps, 0});
    exact *= side_m * side_m / (steps * steps);
    double before = 0;
    for (const double tile_m : {4.0, 2.0, 1.0, 0.5}) {
      double sum = 0;
      uint32_t number = 0;
      for (const Tile& tile : make_tiles(scene, tile_m * (1 + 1e-9))) {
        const glm::dvec3 in = tile.centre_m - tx, out = rx - tile.centre_m;
        const ScatteredWave w = wave(material, glm::normalize(in), glm::normalize(out), 1, number++, tile.area_m2);
        sum += (power(w, 0) + power(w, 1)) / 2 / (glm::dot(in, in) * glm::dot(out, out));
      }
      const double error = std::abs(sum / exact - 1);
      CHECK(error < 4.5e-4 * tile_m * tile_m);
      if (tile_m < 2) CHECK(error < before / 3);  // to 2 m the lobe's errors still cancel
      before = error;
    }
  }
}
