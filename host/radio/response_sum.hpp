// SPDX-License-Identifier: Apache-2.0
// The sum over paths of a exp(-j 2 pi f delay) for some pairs of elements, all frequencies, and several coefficients a
// of each path: one for each time and pair of ports.
#pragma once
#include <complex>
#include <span>
#include <vector>

namespace wavetracer {

// At evenly spaced frequencies few phases are computed directly, and the others follow from them by multiplication: to
// 1e-13 for a million of them.
struct FrequencyAxis {
  explicit FrequencyAxis(std::span<const double> frequencies_hz);
  std::span<const double> frequencies_hz;  // must outlive it
  double step_hz = 0;                      // 0: there are few, or they are not evenly spaced
};

class ResponseSum {
 public:
  static constexpr size_t most_pairs = 32;
  // The number of pairs whose sums stay in a core's cache: 1 to most_pairs.
  static size_t pairs_at_once(const FrequencyAxis& axis, size_t coefficients);

  // The axis must outlive it.
  ResponseSum(const FrequencyAxis& axis, size_t coefficients);
  // Adds a path between this number of pairs, at most pairs_at_once(): its delay and relative amplitude there.
  void add(const double* delay_s, const double* amplitude, size_t pairs,
           std::span<const std::complex<double>> coefficients);
  std::complex<double> value(size_t coefficient, size_t pair, size_t frequency) const {
    const size_t at = place(coefficient, pair, frequency);
    return {re_[at], im_[at]};
  }

 private:
  // Evenly spaced frequencies are side by side; otherwise pairs are.
  size_t place(size_t coefficient, size_t pair, size_t frequency) const {
    return axis_.step_hz != 0 ? (coefficient * pairs_ + pair) * count_ + frequency
                              : (coefficient * count_ + frequency) * pairs_ + pair;
  }
  void add_even(const double* delay_s, const double* amplitude, size_t pairs,
                std::span<const std::complex<double>> coefficients);
  void add_each(const double* delay_s, const double* amplitude, size_t pairs,
                std::span<const std::complex<double>> coefficients);

  const FrequencyAxis& axis_;
  size_t count_, pairs_;
  std::vector<double> re_, im_;
};

}  // namespace wavetracer
