// SPDX-License-Identifier: Apache-2.0
// std::shuffle and the distributions of the standard library may differ between libraries; these functions do not.
#include "accuracy/latin_hypercube.hpp"
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace wavetracer::accuracy {

double normal_quantile(double probability) {
  double lower = -9, upper = 9;
  for (int halving = 0; halving < 60; ++halving) {
    const double x = 0.5 * (lower + upper);
    (0.5 * std::erfc(-x / std::numbers::sqrt2) < probability ? lower : upper) = x;
  }
  return 0.5 * (lower + upper);
}

std::vector<std::vector<double>> normal_hypercube(size_t samples, size_t dimensions, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<double>> out(samples, std::vector<double>(dimensions));
  std::vector<size_t> interval(samples);
  for (size_t dimension = 0; dimension < dimensions; ++dimension) {
    std::iota(interval.begin(), interval.end(), size_t{0});
    for (size_t i = samples; i > 1; --i) std::swap(interval[i - 1], interval[random() % i]);
    for (size_t i = 0; i < samples; ++i) {
      const double within = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
      out[i][dimension] = normal_quantile((static_cast<double>(interval[i]) + within) / static_cast<double>(samples));
    }
  }
  return out;
}

}  // namespace wavetracer::accuracy
