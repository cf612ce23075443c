// SPDX-License-Identifier: Apache-2.0
// Physical optics is not reciprocal between two places; the mean of both ways is.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "bodies/bodies.hpp"

using namespace wavetracer;

namespace {

// The largest difference of two matrices, the second one transposed, over the largest element.
double asymmetry(const std::array<std::complex<double>, 4>& there, const std::array<std::complex<double>, 4>& back) {
  const size_t transposed[] = {0, 2, 1, 3};
  double most = 0, size = 0;
  for (size_t i = 0; i < 4; ++i) {
    most = std::max(most, std::abs(there[i] - back[transposed[i]]));
    size = std::max(size, std::abs(there[i]));
  }
  return most / size;
}

// The same difference as a cross section in dB over 1 m^2. product_m2: of the distances to both ends.
double difference_db(const std::array<std::complex<double>, 4>& there, const std::array<std::complex<double>, 4>& back,
                     double product_m2) {
  const size_t transposed[] = {0, 2, 1, 3};
  double most = 0;
  for (size_t i = 0; i < 4; ++i) most = std::max(most, std::abs(there[i] - back[transposed[i]]));
  return db(4 * pi * std::pow(most * product_m2, 2));
}

}  // namespace

TEST_CASE("both ways differ in physical optics, and agree in the mean") {
  const Body body = box({0.06, 0.05, 0.04});
  double most = 0, level = -300;
  for (double phi = 20; phi <= 100; phi += 10) {
    const glm::dvec3 tx = towards(60, 10) * 100.0, rx = towards(75, 10 + phi) * 120.0;
    const auto there = sum_of(scattered(body, tx, rx, wave_hz), wave_hz);
    const auto back = sum_of(scattered(body, rx, tx, wave_hz), wave_hz);
    most = std::max(most, asymmetry(there, back));
    level = std::max(level, difference_db(there, back, 100 * 120));
    const PhysicalOptics mean{.reciprocal = true};
    CHECK(asymmetry(sum_of(scattered(body, tx, rx, wave_hz, mean), wave_hz),
                    sum_of(scattered(body, rx, tx, wave_hz, mean), wave_hz)) < 1e-9);
  }
  // The largest difference is that of a wave with a cross section far below that of the largest face.
  const double face = db(4 * pi * std::pow(0.06 * 0.05 / wave_m, 2));
  MESSAGE(fmt::format("largest difference: {:.2f} of the field, {:.1f} dB below the largest face", most, face - level));
  CHECK(most > 1e-3);
  CHECK(level < face - 15);
}

TEST_CASE("with both ends in one place, a single bounce is reciprocal, and the specular one always is") {
  const Body body = box({0.06, 0.05, 0.04});
  const PhysicalOptics once{.max_bounces = 1};
  for (const double phi : {5.0, 40.0, 77.0}) {
    const glm::dvec3 end = towards(65, phi) * 100.0;
    const auto sum = sum_of(scattered(body, end, end, wave_hz, once), wave_hz);
    CHECK(asymmetry(sum, sum) < 1e-9);
  }
  const Body plate = conductor({parallelogram({-0.03, -0.03, 0}, {0.06, 0, 0}, {0, 0.06, 0})});
  const glm::dvec3 tx = towards(40, 0) * far_m, rx = towards(40, 180) * far_m;
  CHECK(asymmetry(sum_of(scattered(plate, tx, rx, wave_hz), wave_hz),
                  sum_of(scattered(plate, rx, tx, wave_hz), wave_hz)) < 1e-6);
}
