// SPDX-License-Identifier: Apache-2.0
// Rules of wedge diffraction: reciprocity, limits, finite values, hints, faces that let waves pass. The geometry is
// random, from fixed seeds.
#include <doctest/doctest.h>

#include <random>

#include "radio/constants.hpp"
#include "radio/corner.hpp"
#include "radio/material.hpp"
#include "radio/world.hpp"

using namespace wavetracer;
using test::at_azimuth;
using test::Complex;
using test::concrete_face;
using test::Corner;
using test::CVector;
using test::glass_face;
using test::size;
using test::wavelength_m;

namespace {

using std::numbers::pi;

glm::dvec3 edge_direction(double azimuth, double beta0) {
  return at_azimuth(std::sin(beta0), azimuth, std::cos(beta0));
}

// Returns the coefficients for a source and a receiver at these azimuths, with directions at beta0 to the edge.
Diffraction between(const Corner& corner, double in, double out, double beta0, double length_m,
                    const LitSides& lit = {}) {
  glm::dvec3 k_in = -edge_direction(in, beta0);
  k_in.z = -k_in.z;
  return diffract(corner.frame(), corner.faces, k_in, edge_direction(out, beta0), length_m, wavelength_m,
                  corner.transmits, lit);
}

}  // namespace

TEST_CASE("reciprocity: the coefficient the other way is the transpose, beta turned round at both ends") {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> part(0.01, 0.99);
  for (int i = 0; i < 3000; ++i) {
    const double exterior = pi * (0.05 + 1.95 * part(random)), beta0 = pi * part(random), length_m = 10 * part(random);
    const double in = exterior * part(random), out = exterior * part(random);
    const Corner corner{
        exterior, {concrete_face(), i % 3 ? glass_face() : perfect_conductor}, wavelength_m, i % 2 == 0};
    const Matrix2 there = between(corner, in, out, beta0, length_m).coefficient;
    const Matrix2 back = between(corner, out, in, pi - beta0, length_m).coefficient;
    // The scale is sqrt(L), the coefficient of a whole wave: in corners the four terms may cancel.
    CHECK(size({back[0] - there[0], back[1] + there[2], back[2] + there[1], back[3] - there[3]}) <
          1e-12 * std::sqrt(length_m));
  }
}

TEST_CASE("reciprocity: the field that b receives from a is the one that a receives from b") {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(0.01, 0.99);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const double exterior = pi * (1 + part(random));
    const Corner corner{exterior, {concrete_face(), glass_face()}, wavelength_m, i % 2 == 0};
    const glm::dvec3 a = at_azimuth(3 * part(random), exterior * part(random), 2 * normal(random));
    const glm::dvec3 b = at_azimuth(3 * part(random), exterior * part(random), 2 * normal(random));
    const glm::dvec3 of_a{normal(random), normal(random), normal(random)};
    const glm::dvec3 of_b{normal(random), normal(random), normal(random)};
    const Complex there = test::dot(corner.diffracted(a, b, of_a), of_b);
    const Complex back = test::dot(corner.diffracted(b, a, of_b), of_a);
    const double free_space = glm::length(of_a) * glm::length(of_b) / glm::length(a - b);
    CHECK(std::abs(there - back) < 1e-12 * free_space);
  }
}

TEST_CASE("the numbering of faces does not matter") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0.01, 0.99);
  for (int i = 0; i < 500; ++i) {
    const double exterior = pi * (0.05 + 1.95 * part(random));
    const double in = exterior * part(random), out = exterior * part(random);
    const Corner corner{exterior, {concrete_face(), glass_face()}, wavelength_m, i % 2 == 0};
    const double beta0 = pi * part(random);
    glm::dvec3 k_in = -edge_direction(in, beta0);
    k_in.z = -k_in.z;
    const Diffraction d = between(corner, in, out, beta0, 3);
    const WedgeFrame other{{0, 0, -1}, corner.inward(1), corner.normal(1), exterior};
    const Diffraction e = diffract(other, {glass_face(), concrete_face()}, k_in, edge_direction(out, beta0), 3,
                                   wavelength_m, corner.transmits);
    // Reversing the edge reverses all four vectors of the bases, and the matrix stays the same.
    for (size_t j = 0; j < 2; ++j) {
      CHECK(glm::length(d.from[j] + e.from[j]) < 1e-14);
      CHECK(glm::length(d.to[j] + e.to[j]) < 1e-14);
    }
    // The azimuth of a direction close to the edge has fewer digits.
    for (size_t j = 0; j < 4; ++j)
      CHECK(std::abs(d.coefficient[j] - e.coefficient[j]) < 1e-12 * size(d.coefficient) / std::sin(beta0));
  }
}

TEST_CASE("two faces in one plane diffract nothing; nor does a conducting corner of pi over a whole number") {
  for (const double in : {0.1, 0.4, 0.9}) {
    for (const double out : {0.05, 0.3, 0.77}) {
      for (const double beta0 : {pi / 2, 0.7}) {
        CHECK(size(between({pi, {concrete_face(), concrete_face()}, wavelength_m}, in * pi, out * pi, beta0, 5)
                       .coefficient) < 1e-12);
        for (const double whole : {1, 2, 3, 6, 18}) {
          const Corner corner{pi / whole, {perfect_conductor, perfect_conductor}, wavelength_m};
          CHECK(size(between(corner, in * pi / whole, out * pi / whole, beta0, 5).coefficient) < 1e-12);
        }
        // If the angle between the faces goes to zero, so does their diffraction.
        const auto off_by = [&](double angle) {
          const double exterior = pi + angle;
          const Corner corner{exterior, {concrete_face(), concrete_face()}, wavelength_m};
          return size(between(corner, in * exterior, out * exterior, beta0, 5).coefficient);
        };
        CHECK(off_by(1e-5) < 1.2e-2 * off_by(1e-3));
      }
    }
  }
}

TEST_CASE("finite for every geometry: on boundaries, on faces, along the edge") {
  for (const double exterior_part : {0.05, 0.3, 0.5, 1.0, 1.25, 1.5, 1.999, 2.0}) {
    const double exterior = exterior_part * pi;
    for (const bool transmits : {false, true}) {
      for (const WedgeFace& face : {concrete_face(), perfect_conductor}) {
        const Corner corner{exterior, {face, glass_face()}, wavelength_m, transmits};
        for (const double beta0 : {pi / 2, 0.3, 1e-6, pi - 1e-6, 0.0, pi}) {
          for (const double length_m : {0.0, 1e-9, 1.0, 1e6}) {
            for (int i = 0; i <= 18; ++i) {
              for (int j = 0; j <= 18; ++j) {
                const double in = exterior * i / 18, out = exterior * j / 18;
                const double s = size(between(corner, in, out, beta0, length_m).coefficient);
                REQUIRE(std::isfinite(s));
                REQUIRE(s <= 10 * std::sqrt(length_m));  // each term is at most half of a wave, reflected or not
              }
            }
          }
        }
      }
    }
  }
  const Corner corner{1.5 * pi, {concrete_face(), concrete_face()}, wavelength_m};
  CHECK(size(between(corner, 1, 2, 0, 1).coefficient) == 0);
}

TEST_CASE("hints decide the side where rounding cannot, and only there") {
  const Corner corner{1.5 * pi, {concrete_face(), concrete_face()}, wavelength_m};
  const double in = 0.3, length_m = 4;
  const auto coefficient = [&](double out, const LitSides& lit) {
    return between(corner, in, out, pi / 2, length_m, lit).coefficient;
  };
  const auto distance = [&](const Matrix2& a, const Matrix2& b) {
    return size({a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]});
  };
  struct Case {
    double out;
    LitSides yes, no;
  };
  const double mirror_out = 2 * pi - 2.0;  // for a source at 2.0: face 1 reflects until 3 pi - pi - 2.0
  for (const Case& c : {Case{in + pi, {true, {}}, {false, {}}}, Case{pi - in, {{}, {true, {}}}, {{}, {false, {}}}}}) {
    for (const double off : {-1e-9, 0.0, 1e-9}) {
      const Matrix2 yes = coefficient(c.out + off, c.yes), no = coefficient(c.out + off, c.no);
      CHECK(distance(yes, coefficient(c.out - 2e-6, {})) < 1e-3);
      CHECK(distance(no, coefficient(c.out + 2e-6, {})) < 1e-3);
      CHECK(distance(yes, no) > 0.1 * std::sqrt(length_m));
    }
    CHECK(distance(coefficient(c.out - 2e-6, c.yes), coefficient(c.out - 2e-6, c.no)) == 0);
  }
  const auto at_face_1 = [&](const LitSides& lit) { return between(corner, 2.0, mirror_out, pi / 2, length_m, lit); };
  CHECK(distance(at_face_1({{}, {{{}, true}}}).coefficient, at_face_1({{}, {{{}, false}}}).coefficient) > 0.1);
}

TEST_CASE("grazing along a conducting face: half of the coefficient, so that the direct wave alone is continuous") {
  for (const double exterior : {1.25 * pi, 1.5 * pi, 2 * pi}) {
    const Corner corner{exterior, {perfect_conductor, perfect_conductor}, wavelength_m};
    const double length_m = 9;
    for (const bool swapped : {false, true}) {
      const auto hard = [&](double out) {
        return (swapped ? between(corner, out, 0, pi / 2, length_m) : between(corner, 0, out, pi / 2, length_m))
            .coefficient[3];
      };
      // The direct wave is minus identity in these bases, and vanishes behind pi.
      const Complex jump = hard(pi + 1e-9) - hard(pi - 1e-9) - std::sqrt(length_m) * Complex{-1};
      CHECK(std::abs(jump) < 1e-6);
      const Matrix2 beside = between(corner, swapped ? 2 : 1e-8, swapped ? 1e-8 : 2, pi / 2, length_m).coefficient;
      CHECK(std::abs(hard(2) - beside[3] / 2.0) < 1e-6);
    }
  }
}

TEST_CASE("an empty screen that transmits diffracts nothing at all") {
  const Corner corner{2 * pi, {WedgeFace{1, 0.1}, WedgeFace{1, 0.0}}, wavelength_m, true};
  const Corner thin{2 * pi, {WedgeFace{1, 0.0}, WedgeFace{1, 0.0}}, wavelength_m, true};
  for (const double out : {0.5, 2.0, 4.0, 5.9}) {
    CHECK(size(between(thin, 1, out, 0.8, 5).coefficient) < 1e-12);
    CHECK(size(between(corner, 1, out, 0.8, 5).coefficient) > 1e-3);  // a phase of one pass through 0.1 m
  }
}

TEST_CASE("transfer: an edge's matrix between its bases") {
  // A conducting half plane far from its boundaries, straight through: minus identity in edge-fixed bases is no change.
  const Corner corner{2 * pi, {perfect_conductor, perfect_conductor}, wavelength_m};
  const glm::dvec3 k = edge_direction(4.0, 0.9);
  Diffraction d = diffract(corner.frame(), corner.faces, k, k, 1, wavelength_m);
  Transfer same(basis_of(k)), mixed(basis_of(k));
  same.map(d.from, d.to, {-1.0, 0.0, 0.0, -1.0});
  const Matrix2 m = same.seen_in(basis_of(k));
  CHECK(std::abs(m[0] - 1.0) + std::abs(m[1]) + std::abs(m[2]) + std::abs(m[3] - 1.0) < 1e-14);

  const Matrix2 given{Complex{1, 2}, Complex{3, -1}, Complex{0, 5}, Complex{-2, 1}};
  mixed.map(d.from, d.to, given);
  const Matrix2 got = mixed.seen_in({d.to[0], d.to[1]});
  const SphericalBasis b = basis_of(k);
  for (size_t column = 0; column < 2; ++column) {
    const glm::dvec3 e = column == 0 ? b.theta : b.phi;
    for (size_t row = 0; row < 2; ++row) {
      const Complex expected = given[2 * row] * glm::dot(d.from[0], e) + given[2 * row + 1] * glm::dot(d.from[1], e);
      CHECK(std::abs(got[2 * row + column] - expected) < 1e-13);
    }
  }
}
