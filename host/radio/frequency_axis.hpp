// Phases of a delay at many frequencies: exp(-j 2 pi f delay).
#pragma once
#include <span>
#include <vector>

namespace wavetracer {

// Where frequencies are evenly spaced, few phases take a sine of their own, and the others follow from them by
// multiplication: to 1e-13 for a million of them.
class FrequencyAxis {
 public:
  // The frequencies must outlive it.
  explicit FrequencyAxis(std::span<const double> frequencies_hz);
  size_t size() const { return frequencies_hz_.size(); }
  // Real and imaginary parts, of size() each.
  void phases(double delay_s, double* re, double* im) const;

 private:
  std::span<const double> frequencies_hz_;
  double step_hz_ = 0;  // 0: not evenly spaced
};

}  // namespace wavetracer
