// SPDX-License-Identifier: Apache-2.0
// Compares correlation, autocorrelation and running means with closed forms.
// Bounds on random series are five of their standard errors; seeds are fixed.
#include "study/statistics.hpp"
#include <doctest/doctest.h>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

using namespace wavetracer::study;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> noise(size_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> out(count);
  for (double& value : out) value = normal(random);
  return out;
}

// Equation 3.4 as printed.
double printed_autocorrelation(const std::vector<double>& x, size_t lag) {
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
  double above = 0, below = 0;
  for (size_t i = 0; i + lag < x.size(); ++i) above += (x[i] - mean) * (x[i + lag] - mean);
  for (const double value : x) below += (value - mean) * (value - mean);
  return above / below;
}

}  // namespace

TEST_CASE("pearson: a linear relation gives 1 or -1, whatever offset and scale") {
  const std::vector<double> x = noise(1000, 1);
  for (const double slope : {2.0, -0.5, 1e-9, -1e9})
    for (const double offset : {0.0, -3.0, 1e6 * slope}) {
      std::vector<double> y;
      for (const double value : x) y.push_back(offset + slope * value);
      CHECK(pearson(x, y) == doctest::Approx(slope > 0 ? 1 : -1).epsilon(1e-9));
    }
}

TEST_CASE("pearson: values by hand") {
  // Deviations (-1, 0, 1) and (-4, 5, -1) / 3: 1 / sqrt(2 * 42 / 9).
  CHECK(pearson(std::vector<double>{1, 2, 3}, std::vector<double>{1, 4, 2}) ==
        doctest::Approx(1 / std::sqrt(2 * 42.0 / 9)));
  // Orthogonal: one period of sine and cosine.
  std::vector<double> sine, cosine;
  for (int i = 0; i < 64; ++i) {
    sine.push_back(std::sin(2 * pi * i / 64));
    cosine.push_back(std::cos(2 * pi * i / 64));
  }
  CHECK(std::abs(pearson(sine, cosine)) < 1e-14);
}

TEST_CASE("pearson: independent noise is uncorrelated; a mixture has its share") {
  const std::vector<double> x = noise(100000, 1), e = noise(100000, 2);
  CHECK(std::abs(pearson(x, e)) < 5 / std::sqrt(1e5));
  std::vector<double> y;
  for (size_t i = 0; i < x.size(); ++i) y.push_back(0.6 * x[i] + 0.8 * e[i]);
  CHECK(std::abs(pearson(x, y) - 0.6) < 5 * (1 - 0.36) / std::sqrt(1e5));
}

TEST_CASE("pearson: a far offset costs no digits") {
  // With sums of squares minus squared sums, nothing remains in double of a spread of 1e-3 at 1e6 but noise of 1e-3.
  const std::vector<double> x = noise(1000, 1);
  std::vector<double> far, far_up;
  for (const double value : x) {
    far.push_back(1e6 + 1e-3 * value);
    far_up.push_back(-1e6 + 1e-3 * value);
  }
  CHECK(pearson(far, far_up) == doctest::Approx(1).epsilon(1e-10));
}

TEST_CASE("pearson: where it is not defined") {
  const std::vector<double> x = {1, 2, 3}, constant(3, 0.1);
  CHECK(std::isnan(pearson({}, {})));
  CHECK(std::isnan(pearson(std::vector<double>{1}, std::vector<double>{2})));
  CHECK(std::isnan(pearson(x, constant)));
  CHECK(std::isnan(pearson(constant, x)));
  CHECK(std::isnan(pearson(constant, constant)));
  const std::vector<double> wall = {5, 5.00001, 4.99999};  // equal but for the rounding of float32
  CHECK(pearson(x, wall) == doctest::Approx(-0.5));
  CHECK(std::isnan(pearson(x, wall, 1e-3)));
  CHECK_THROWS_AS(pearson(x, std::vector<double>{1, 2}), std::invalid_argument);
}

TEST_CASE("autocorrelation: a sine gives the cosine of the lag, where the printed sum fades") {
  const size_t count = 1000, period = 50;
  std::vector<double> x;
  for (size_t i = 0; i < count; ++i) x.push_back(7 + 3 * std::sin(2 * pi * static_cast<double>(i) / period));
  const std::vector<uint32_t> lags = {0, 1, 5, 25, 50, 500};  // at 500 both lists are whole periods
  const std::vector<double> r = autocorrelation(x, lags);
  for (size_t k = 0; k < lags.size(); ++k) {
    CAPTURE(lags[k]);
    // Up to the part of a period that is cut off.
    CHECK(r[k] == doctest::Approx(std::cos(2 * pi * lags[k] / period)).epsilon(0.02).scale(1));
  }
  CHECK(r[0] == doctest::Approx(1));
  CHECK(r[4] == doctest::Approx(1).epsilon(1e-9));
  CHECK(r[5] == doctest::Approx(1).epsilon(1e-9));
  CHECK(printed_autocorrelation(x, 500) == doctest::Approx(0.5));
}

TEST_CASE("autocorrelation: an AR(1) process gives rho to the lag; noise gives none") {
  const double rho = 0.9;
  const std::vector<double> e = noise(200000, 3);
  std::vector<double> x = {0};
  for (const double value : e) x.push_back(rho * x.back() + std::sqrt(1 - rho * rho) * value);
  const std::vector<uint32_t> lags = {1, 2, 5, 10, 100};
  const std::vector<double> r = autocorrelation(x, lags), white = autocorrelation(e, lags);
  for (size_t k = 0; k < lags.size(); ++k) {
    CAPTURE(lags[k]);
    // Bartlett: the variance of r_k is at most (1 + rho^2) / (1 - rho^2) / N.
    CHECK(std::abs(r[k] - std::pow(rho, lags[k])) < 5 * std::sqrt((1 + rho * rho) / (1 - rho * rho) / 2e5));
    CHECK(std::abs(white[k]) < 5 / std::sqrt(2e5));
  }
}

TEST_CASE("autocorrelation: missing values leave the coefficient of the others") {
  std::vector<double> x;
  for (int i = 0; i < 1000; ++i) x.push_back(i % 2);  // -1 at odd lags, 1 at even
  for (int i = 0; i < 1000; ++i)
    if (i % 10 < 4) x[i] = undefined;  // as many even as odd ones
  const std::vector<double> r = autocorrelation(x, std::vector<uint32_t>{1, 2, 3, 500, 998, 5000});
  CHECK(r[0] == doctest::Approx(-1));
  CHECK(r[1] == doctest::Approx(1));
  CHECK(r[2] == doctest::Approx(-1));
  CHECK(r[3] == doctest::Approx(1));
  CHECK(std::isnan(r[4]));  // 0 and 1 are missing
  CHECK(std::isnan(r[5]));
}

TEST_CASE("autocorrelation: values without a partner do not make that of the others smaller") {
  std::vector<double> x;
  for (int i = 0; i < 1000; ++i) x.push_back(i % 2 == 0 ? 1 : -1);
  for (const double far : {100.0, -100.0}) x.insert(x.end(), {undefined, far});
  CHECK(autocorrelation(x, std::vector<uint32_t>{1})[0] == doctest::Approx(-1));
}

TEST_CASE("autocorrelation: where it is not defined") {
  const std::vector<uint32_t> lags = {0, 1};
  const std::vector<std::vector<double>> cases = {{}, {1}, {0.1, 0.1, 0.1}, {undefined, undefined}};
  for (const auto& values : cases)
    for (const double r : autocorrelation(values, lags)) CHECK(std::isnan(r));
}

TEST_CASE("autocorrelation: points on a circle turn with the lag") {
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 3600; ++i)
    points.emplace_back(100 + std::cos(2 * pi * i / 36), -50 + std::sin(2 * pi * i / 36), 3);
  const std::vector<double> r = autocorrelation(points, std::vector<uint32_t>{3, 9, 18, 36});
  CHECK(r[0] == doctest::Approx(std::cos(pi / 6)));
  CHECK(std::abs(r[1]) < 1e-9);
  CHECK(r[2] == doctest::Approx(-1));
  CHECK(r[3] == doctest::Approx(1));
}

TEST_CASE("running mean: 500 cycles agree with the sums, and say how sure they are") {
  RunningMean running;
  CHECK(std::isnan(running.mean()));
  const std::vector<double> x = noise(500, 4);
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    running.add(1e9 + x[i]);
    sum += x[i];
    if (i == 0) CHECK(std::isnan(running.standard_error()));
  }
  CHECK(running.count() == 500);
  CHECK(running.mean() - 1e9 == doctest::Approx(sum / 500).epsilon(1e-5));
  double squares = 0;
  for (const double value : x) squares += (value - sum / 500) * (value - sum / 500);
  CHECK(running.standard_error() == doctest::Approx(std::sqrt(squares / 499 / 500)).epsilon(1e-5));
  running.add(undefined);
  CHECK(std::isnan(running.mean()));
}
