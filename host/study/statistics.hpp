// SPDX-License-Identifier: Apache-2.0
// Correlation, autocorrelation and running averages, as in the thesis' equations 3.3, 3.4 and 6.2.
// A. Zhdanov, TU Munich, 2014. Sums are of deviations from a mean computed before, so offsets do not cost digits.
#pragma once
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace wavetracer::study {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

// Returns Pearson's coefficient of pairs (x[i], y[i]); equation 3.3. It is NaN if undefined: fewer than two pairs, or a
// list whose standard deviation is `resolution` or less, which counts as constant. Throws std::invalid_argument for
// lists of different lengths.
double pearson(std::span<const double> x, std::span<const double> y, double resolution = 0);

// Returns for each lag k >= 0 the autocorrelation of values[i] with values[i + k]; equation 3.4, but divided by the
// squares of the paired values only: dividing by those of all N would make a coefficient smaller the fewer pairs there
// are, N - k or less if values are missing. Deviations are from the mean of all values. NaN (for points: in x) means a
// missing value. Points count as vectors: products are dot products. A coefficient is NaN if no pair has that lag or
// all values are equal.
std::vector<double> autocorrelation(std::span<const double> values, std::span<const uint32_t> lags);
std::vector<double> autocorrelation(std::span<const glm::dvec3> points, std::span<const uint32_t> lags);

// The mean of the values so far (equation 6.2) and its uncertainty, which the thesis leaves out; only three numbers are
// stored (B. P. Welford, Technometrics 1962). A value that is not finite makes both NaN from then on.
class RunningMean {
 public:
  void add(double value) {
    ++count_;
    const double before = value - mean_;
    mean_ += before / static_cast<double>(count_);
    squares_ += before * (value - mean_);
  }
  uint64_t count() const { return count_; }
  double mean() const { return count_ == 0 ? undefined : mean_; }
  // Standard error of the mean, if values are independent; NaN for fewer than two.
  double standard_error() const {
    const auto n = static_cast<double>(count_);
    return count_ < 2 ? undefined : std::sqrt(squares_ / (n * (n - 1)));
  }

 private:
  uint64_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

}  // namespace wavetracer::study
