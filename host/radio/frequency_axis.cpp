// Evenly spaced frequencies are taken in blocks: phases of the first block, and one factor per block for the others.
#include "radio/frequency_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace wavetracer {
namespace {

constexpr size_t block = 16;
using Complex = std::complex<double>;

// Whole turns are left out before the sine is taken.
Complex phase_of(double turns) { return std::polar(1.0, -2 * std::numbers::pi * (turns - std::floor(turns))); }

// Without the checks for infinities that operator* makes.
Complex product(const Complex& a, const Complex& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

FrequencyAxis::FrequencyAxis(std::span<const double> frequencies_hz) : frequencies_hz_(frequencies_hz) {
  if (size() < block) return;
  const double first = frequencies_hz.front(), step = (frequencies_hz.back() - first) / static_cast<double>(size() - 1);
  bool even = step != 0;
  for (size_t k = 0; k < size(); ++k) {
    const double error = std::abs(frequencies_hz[k] - (first + static_cast<double>(k) * step));
    even &= error <= 4 * std::numeric_limits<double>::epsilon() * std::abs(frequencies_hz[k]);
  }
  if (even) step_hz_ = step;
}

void FrequencyAxis::phases(double delay_s, double* re, double* im) const {
  if (step_hz_ == 0) {
    for (size_t k = 0; k < size(); ++k) {
      const Complex z = phase_of(frequencies_hz_[k] * delay_s);
      re[k] = z.real();
      im[k] = z.imag();
    }
    return;
  }
  std::array<double, block> step_re, step_im;
  Complex along(1);
  const Complex step = phase_of(step_hz_ * delay_s);
  for (size_t j = 0; j < block; ++j) {
    step_re[j] = along.real();
    step_im[j] = along.imag();
    along = product(along, step);
  }
  Complex base = phase_of(frequencies_hz_.front() * delay_s);
  for (size_t first = 0; first < size(); first += block) {
    const double base_re = base.real(), base_im = base.imag();
    const size_t count = std::min(block, size() - first);
    for (size_t j = 0; j < count; ++j) {
      re[first + j] = base_re * step_re[j] - base_im * step_im[j];
      im[first + j] = base_re * step_im[j] + base_im * step_re[j];
    }
    base = product(base, along);
  }
}

}  // namespace wavetracer
