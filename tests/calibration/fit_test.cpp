// SPDX-License-Identifier: Apache-2.0
// Fits of models whose answers are known: lines, whose least squares have closed forms, and an exponential.
#include "calibration/fit.hpp"
#include "calibration/residual_cost.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace wavetracer::calibration;

namespace {

constexpr double no_prior = 1e9;

FitResult fitted(const Problem& problem) {
  Linearized model(problem);
  return fit(problem, model, std::vector<bool>(problem.data.size(), true),
             std::vector<double>(problem.priors.size(), 0));
}

// A line theta x over x = 0, 0.1, 0.2, ..., with data of noise of this deviation, and an offset.
struct Line {
  std::vector<double> x;
  Problem problem;

  Line(size_t count, double slope, double offset, double deviation, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, 1);
    for (size_t i = 0; i < count; ++i) {
      x.push_back(0.1 * static_cast<double>(i));
      problem.data.push_back({.value = slope * x[i] + offset + deviation * noise(random), .offset = 0});
    }
    problem.priors = {no_prior};
    problem.offsets = 1;
    problem.model = [this](std::span<const double> theta) {
      std::vector<double> out;
      for (const double at : x) out.push_back(theta[0] * at);
      return out;
    };
  }
};

}  // namespace

TEST_CASE("a line without noise is found exactly") {
  const Line line(20, 2.5, -7, 0, 1);
  const FitResult found = fitted(line.problem);
  CHECK(found.converged);
  CHECK(found.theta[0] == doctest::Approx(2.5).epsilon(1e-9));
  CHECK(found.offsets[0] == doctest::Approx(-7).epsilon(1e-9));
}

TEST_CASE("standard errors and correlations of a line are those of its closed form") {
  const Line line(400, 1.5, 3, 0.5, 2);
  const FitResult found = fitted(line.problem);
  double sum = 0, square = 0;
  for (const double x : line.x) {
    sum += x;
    square += x * x;
  }
  const double n = 400, determinant = n * square - sum * sum;
  CHECK(found.deviations[0] == doctest::Approx(0.5).epsilon(0.1));
  // A residual beyond two deviations counts less, which some 5% are.
  CHECK(found.errors[0] == doctest::Approx(0.5 * std::sqrt(n / determinant)).epsilon(0.12));
  CHECK(found.errors[1] == doctest::Approx(0.5 * std::sqrt(square / determinant)).epsilon(0.12));
  CHECK(found.correlation[1] == doctest::Approx(-sum / std::sqrt(n * square)).epsilon(0.02));
  CHECK(std::abs(found.theta[0] - 1.5) < 4 * found.errors[0]);
  CHECK(found.told[0] == doctest::Approx(1));
}

TEST_CASE("errors of many fits are as large as their standard errors say") {
  double sum = 0, said = 0;
  constexpr unsigned fits = 200;
  for (unsigned seed = 0; seed < fits; ++seed) {
    const Line line(100, 1, 0, 1, 100 + seed);
    const FitResult found = fitted(line.problem);
    sum += std::pow(found.theta[0] - 1, 2);
    said += std::pow(found.errors[0], 2);
  }
  // The bound of Cramer and Rao is 1 / (n times the variance of x): Huber's function costs some 1% of it.
  const double bound = 1 / (100 * (0.01 * (100.0 * 100 - 1) / 12));
  CHECK(sum / fits < 1.2 * 1.2 * bound);
  CHECK(sum / said == doctest::Approx(1).epsilon(0.25));
}

TEST_CASE("a tenth of outliers hardly moves a fit") {
  Line line(200, 2, 1, 0.1, 5);
  for (size_t i = 0; i < line.problem.data.size(); i += 10) line.problem.data[i].value += 50;
  const FitResult found = fitted(line.problem);
  CHECK(found.theta[0] == doctest::Approx(2).epsilon(0.01));
  CHECK(std::abs(found.offsets[0] - 1) < 0.1);
}

TEST_CASE("a prior holds what the data do not tell") {
  Line line(50, 2, 0, 0.1, 6);
  line.problem.priors = {no_prior, 0.3};
  const auto alone = line.problem.model;
  line.problem.model = [&](std::span<const double> theta) { return alone(theta.first(1)); };
  Linearized model(line.problem);
  const FitResult found = fit(line.problem, model, std::vector<bool>(50, true), {0, 0});
  CHECK(found.theta[0] == doctest::Approx(2).epsilon(0.05));
  CHECK(found.theta[1] == 0);
  CHECK(found.errors[1] == doctest::Approx(0.3));
  CHECK(found.told[1] == doctest::Approx(0));
  CHECK(model.depends_on(0));
  CHECK_FALSE(model.depends_on(1));
}

TEST_CASE("levels below the noise count as such: without them the slope is wrong") {
  Line line(200, -1, 0, 0.2, 7);  // from 0 down to -20
  constexpr double floor = -10;
  std::vector<bool> above;
  for (Datum& datum : line.problem.data) {
    above.push_back(datum.value > floor);
    if (!above.back()) datum = {.value = floor, .below = true, .offset = 0};
  }
  const FitResult found = fitted(line.problem);
  CHECK(found.theta[0] == doctest::Approx(-1).epsilon(0.02));
  Problem as_levels = line.problem;
  for (Datum& datum : as_levels.data) datum.below = false;
  CHECK(fitted(as_levels).theta[0] > -0.9);
}

TEST_CASE("the probability of being below a number has the right slope far below and far above it") {
  // One datum that is below 0, a prior of 1 and a model theta: the posterior's mode solves theta = -density /
  // probability.
  Problem problem;
  problem.data = {{.value = -3, .below = true}, {.value = 5}, {.value = -5}};  // deviation 1.4826 * 5 about 0
  problem.priors = {1};
  problem.model = [](std::span<const double> theta) { return std::vector<double>{theta[0], 0, 0}; };
  Linearized model(problem);
  const FitResult found = fit(problem, model, {true, true, true}, {0});
  const double s = 1.4826 * 5, u = (-3 - found.theta[0]) / s;
  const double ratio = std::exp(-0.5 * u * u) / std::sqrt(2 * std::acos(-1.0)) / (0.5 * std::erfc(-u / std::sqrt(2.0)));
  CHECK(found.theta[0] == doctest::Approx(-ratio / s).epsilon(1e-2));
}

TEST_CASE("a curved model is found from afar, and data without a value are left out") {
  Problem problem;
  for (int i = 0; i < 30; ++i) problem.data.push_back({.value = 10 * std::exp(0.2 * i * 0.7)});
  problem.priors = {no_prior};
  problem.model = [](std::span<const double> theta) {
    std::vector<double> out;
    for (int i = 0; i < 30; ++i) out.push_back(i == 7 ? -INFINITY : 10 * std::exp(0.2 * i * theta[0]));
    return out;
  };
  const FitResult found = fitted(problem);
  CHECK(found.used == 29);
  CHECK(found.theta[0] == doctest::Approx(0.7).epsilon(1e-6));
}

TEST_CASE("an offset that no datum has stays 0") {
  Line line(30, 2, 1, 0.1, 11);
  line.problem.offsets = 2;
  const FitResult found = fitted(line.problem);
  CHECK(found.theta[0] == doctest::Approx(2).epsilon(0.05));
  CHECK(found.offsets[0] == doctest::Approx(1).epsilon(0.1));
  CHECK(found.offsets[1] == 0);
}

TEST_CASE("held-out data have no effect") {
  const Line line(40, 2, 0, 0, 8);
  Problem problem = line.problem;
  std::vector<bool> takes(40, true);
  for (size_t i = 0; i < 10; ++i) {
    takes[i] = false;
    problem.data[i].value = 1e6;
  }
  Linearized model(problem);
  const FitResult found = fit(problem, model, takes, {0});
  CHECK(found.used == 30);
  CHECK(found.theta[0] == doctest::Approx(2).epsilon(1e-9));
}

TEST_CASE("slopes with a step to both sides leave out a jump on either side") {
  Problem problem;
  problem.data.resize(3);
  problem.priors = {no_prior};
  problem.steps = {{.size = 0.01, .both_sides = true}};
  // One value jumps at 0.005, one at -0.005, and one has a bend.
  problem.model = [](std::span<const double> theta) {
    const double t = theta[0];
    return std::vector<double>{3 * t + (t > 0.005 ? 7 : 0), -2 * t + (t < -0.005 ? 7 : 0), t * t};
  };
  Linearized both(problem);
  const auto slopes = both.slopes({0});
  CHECK(slopes[0][0] == doctest::Approx(3));
  CHECK(slopes[0][1] == doctest::Approx(-2));
  CHECK(std::abs(slopes[0][2]) <= 0.01 + 1e-12);
  CHECK(both.evaluations() == 3);
  problem.steps = {{.size = 0.01}};
  Linearized one(problem);
  CHECK(one.slopes({0})[0][0] == doctest::Approx(703));
}

TEST_CASE("a datum that loses its value on the way does not stop the fit") {
  Problem problem;
  for (int i = 0; i < 20; ++i) problem.data.push_back({.value = 0.1 * i});
  problem.priors = {no_prior};
  problem.model = [](std::span<const double> theta) {
    std::vector<double> out;
    for (int i = 0; i < 20; ++i) out.push_back(i == 7 && theta[0] > 0.5 ? -INFINITY : 0.1 * i * theta[0]);
    return out;
  };
  const FitResult found = fitted(problem);
  CHECK(found.used == 20);
  CHECK(found.theta[0] == doctest::Approx(1).epsilon(1e-6));
  CHECK(std::isfinite(found.errors[0]));
}

TEST_CASE("costs have the slopes that they say, and the tails of Student's t outweigh no exact fit") {
  for (const double u : {-9.0, -1.5, 0.3, 1.7, 5.0}) {
    constexpr double s = 0.7, step = 1e-6;
    CAPTURE(u);
    for (const auto& cost : {normal_cost, below_cost}) {
      const double rise = (cost(u - step / s, s).cost - cost(u + step / s, s).cost) / (2 * step);
      CHECK(cost(u, s).slope == doctest::Approx(rise).epsilon(1e-5));
    }
  }
  CHECK(tailed_cost(0) == 0);
  CHECK(tailed_cost(2) == doctest::Approx(2.5 * std::log(2)));
  CHECK(tailed_cost(1e7) < 80);
}

TEST_CASE("of two starts the one is followed to an exact fit that has an outlier") {
  Problem problem;
  for (int i = 0; i < 20; ++i) problem.data.push_back({.value = i == 4 ? 50.0 : 3.0 + 0.2 * i});
  problem.priors = {no_prior};
  // Between the two valleys is a ridge; the far one fits all data but one exactly, the near one fits none.
  problem.model = [](std::span<const double> theta) {
    std::vector<double> out;
    const double t = theta[0], away = t > 2 ? t - 3 : 1 + t * t;
    for (int i = 0; i < 20; ++i) out.push_back(3 + 0.2 * i + away * (1 + i % 3));
    return out;
  };
  Linearized model(problem);
  const FitResult found = fit_from_best(problem, model, std::vector<bool>(20, true), {{0}, {2.8}});
  CHECK(found.theta[0] == doctest::Approx(3).epsilon(1e-6));
}
