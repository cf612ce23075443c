// SPDX-License-Identifier: Apache-2.0
#include "calibration/residual_cost.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace wavetracer::calibration {
namespace {

constexpr double huber = 2;  // deviations beyond which the cost of a residual is linear

}  // namespace

Cost normal_cost(double u, double s) {
  const double size = std::abs(u);
  if (size <= huber) return {0.5 * u * u, -u / s, 1 / (s * s)};
  return {huber * (size - 0.5 * huber), -std::copysign(huber, u) / s, huber / (size * s * s)};
}

double tailed_cost(double u) { return 2.5 * std::log1p(u * u / 4); }

Cost below_cost(double u, double s) {
  // Mills' ratio by its continued fraction where the normal distribution vanishes.
  double ratio = 0, cost = 0;  // density / probability
  if (u < -8) {
    ratio = -u + 1 / (-u + 2 / (-u + 3 / (-u)));
    cost = 0.5 * u * u + 0.5 * std::log(2 * std::numbers::pi) + std::log(ratio);
  } else {
    const double probability = 0.5 * std::erfc(-u / std::numbers::sqrt2);
    ratio = std::exp(-0.5 * u * u) / std::sqrt(2 * std::numbers::pi) / probability;
    cost = -std::log(probability);
  }
  return {cost, ratio / s, std::max(0.0, ratio * (ratio + u)) / (s * s)};
}

}  // namespace wavetracer::calibration
