// SPDX-License-Identifier: Apache-2.0
// Uses two passes: means, then products of deviations. Values are counted from the first one, so that equal values have
// deviations of exactly zero.
#include "study/statistics.hpp"
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>

namespace wavetracer::study {
namespace {

// Returns x minus its mean.
std::vector<double> deviations(std::span<const double> x) {
  std::vector<double> out(x.begin(), x.end());
  double sum = 0;
  for (double& value : out) sum += value -= x.front();
  for (double& value : out) value -= sum / static_cast<double>(x.size());
  return out;
}

double product(double a, double b) { return a * b; }
double product(const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, b); }

bool missing(double value) { return std::isnan(value); }
bool missing(const glm::dvec3& value) { return std::isnan(value.x); }

template <class Value>
std::vector<double> autocorrelation_of(std::span<const Value> values, std::span<const uint32_t> lags) {
  std::optional<Value> first;
  Value sum{};
  uint64_t count = 0;
  for (const Value& value : values) {
    if (missing(value)) continue;
    if (!first) first = value;
    sum += value - *first;
    ++count;
  }
  std::vector<double> out(lags.size(), undefined);
  if (count == 0) return out;
  std::vector<Value> deviation(values.begin(), values.end());  // those of missing values stay NaN
  for (Value& value : deviation) value = value - *first - sum / static_cast<double>(count);

  for (size_t k = 0; k < lags.size(); ++k) {
    double early = 0, late = 0, both = 0;
    for (size_t i = 0; i + lags[k] < deviation.size(); ++i) {
      const Value &a = deviation[i], &b = deviation[i + lags[k]];
      if (missing(a) || missing(b)) continue;
      early += product(a, a);
      late += product(b, b);
      both += product(a, b);
    }
    if (early > 0 && late > 0) out[k] = both / (std::sqrt(early) * std::sqrt(late));
  }
  return out;
}

}  // namespace

double pearson(std::span<const double> x, std::span<const double> y, double resolution) {
  if (x.size() != y.size()) throw std::invalid_argument("pearson: lists of different lengths");
  if (x.size() < 2) return undefined;
  const std::vector<double> dx = deviations(x), dy = deviations(y);
  double xx = 0, yy = 0, xy = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    xx += dx[i] * dx[i];
    yy += dy[i] * dy[i];
    xy += dx[i] * dy[i];
  }
  const double constant = resolution * resolution * static_cast<double>(x.size());
  if (xx <= constant || yy <= constant) return undefined;
  return xy / (std::sqrt(xx) * std::sqrt(yy));
}

std::vector<double> autocorrelation(std::span<const double> values, std::span<const uint32_t> lags) {
  return autocorrelation_of(values, lags);
}

std::vector<double> autocorrelation(std::span<const glm::dvec3> points, std::span<const uint32_t> lags) {
  return autocorrelation_of(points, lags);
}

}  // namespace wavetracer::study
