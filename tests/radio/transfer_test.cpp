// SPDX-License-Identifier: Apache-2.0
// The travelling field compared with reflections computed by hand.
// The mirror of a perfect conductor reverses the tangential field and keeps the normal one.
#include "radio/transfer.hpp"

#include <doctest/doctest.h>

#include <random>

using namespace wavetracer;

namespace {

glm::dvec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3{normal(random), normal(random), normal(random)});
}

// The field vector at the end of a transfer for a unit field along theta (column 0) or phi (column 1).
glm::dvec3 field(const Matrix2& m, size_t column, const SphericalBasis& b) {
  return m[column].real() * b.theta + m[2 + column].real() * b.phi;
}

}  // namespace

TEST_CASE("a perfect conductor mirrors the field: E_out = 2 (n . E) n - E") {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 n = random_unit(random);
    // Every tenth at or close to normal incidence, where TE and TM lose their meaning.
    glm::dvec3 k = i % 10 == 0 ? -n : random_unit(random);
    if (i % 20 == 10) k = glm::normalize(k + 1e-9 * random_unit(random));
    const glm::dvec3 out = glm::reflect(k, n);
    Transfer transfer(basis_of(k));
    transfer.meet(k, out, n, -1.0, 1.0);
    const SphericalBasis from = basis_of(k), to = basis_of(out);
    const Matrix2 m = transfer.seen_in(to);
    for (size_t column = 0; column < 2; ++column) {
      const glm::dvec3 in = column == 0 ? from.theta : from.phi;
      CHECK(glm::length(field(m, column, to) - (2 * glm::dot(n, in) * n - in)) < 2e-8);
    }
  }
}

TEST_CASE("an untouched wave keeps its field") {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 k = random_unit(random), n = random_unit(random);
    Transfer transfer(basis_of(k));
    transfer.meet(k, k, n, 1.0, 1.0);
    const Matrix2 m = transfer.seen_in(basis_of(k));
    CHECK(std::abs(m[0] - 1.0) + std::abs(m[1]) + std::abs(m[2]) + std::abs(m[3] - 1.0) < 1e-14);
    // Seen from the receiver's side phi-hat is reversed: V stays V, H changes its sign.
    const Matrix2 back = transfer.seen_in(basis_of(-k));
    CHECK(std::abs(back[0] - 1.0) + std::abs(back[1]) + std::abs(back[2]) + std::abs(back[3] + 1.0) < 1e-14);
  }
}
