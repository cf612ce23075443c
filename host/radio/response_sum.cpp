// SPDX-License-Identifier: Apache-2.0
// These loops let compilers take several elements at a time: real and imaginary parts are apart, and there are no
// branches.
#include "radio/response_sum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "radio/unit_phases.hpp"
#include "radio/wide_loops.hpp"

namespace wavetracer {
namespace {

constexpr size_t frequency_block = 16;
using PairColumn = std::array<double, ResponseSum::most_pairs>;

// A product without the checks for infinities that operator* makes.
std::complex<double> product(const std::complex<double>& a, const std::complex<double>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

FrequencyAxis::FrequencyAxis(std::span<const double> frequencies) : frequencies_hz(frequencies) {
  const size_t count = frequencies.size();
  if (count < frequency_block) return;
  const double first = frequencies.front(), step = (frequencies.back() - first) / static_cast<double>(count - 1);
  bool even = step != 0;
  for (size_t k = 0; k < count; ++k) {
    const double error = std::abs(frequencies[k] - (first + static_cast<double>(k) * step));
    even &= error <= 4 * std::numeric_limits<double>::epsilon() * std::abs(frequencies[k]);
  }
  if (even) step_hz = step;
}

ResponseSum::ResponseSum(const FrequencyAxis& axis, size_t coefficients)
    : axis_(axis),
      count_(axis.frequencies_hz.size()),
      pairs_(pairs_at_once(axis, coefficients)),
      re_(coefficients * count_ * pairs_),
      im_(coefficients * count_ * pairs_) {}

size_t ResponseSum::pairs_at_once(const FrequencyAxis& axis, size_t coefficients) {
  constexpr size_t values = 16384;  // 256 KiB
  return std::clamp<size_t>(values / std::max<size_t>(axis.frequencies_hz.size() * coefficients, 1), 1, most_pairs);
}

void ResponseSum::add(const double* delay_s, const double* amplitude, size_t pairs,
                      std::span<const std::complex<double>> coefficients) {
  if (axis_.step_hz != 0)
    add_even(delay_s, amplitude, pairs, coefficients);
  else
    add_each(delay_s, amplitude, pairs, coefficients);
}

// Frequencies come in blocks: the phases within a block are the same for all of them, and one factor leads to the next.
WAVETRACER_WIDE void ResponseSum::add_even(const double* delay_s, const double* amplitude, size_t pairs,
                                           std::span<const std::complex<double>> coefficients) {
  PairColumn turns, first_re, first_im, step_re, step_im;
  const auto phases_at = [&](double frequency_hz, PairColumn& re, PairColumn& im) {
    for (size_t i = 0; i < pairs; ++i) turns[i] = frequency_hz * delay_s[i];
    unit_phases(turns.data(), pairs, re.data(), im.data());
  };
  phases_at(axis_.frequencies_hz.front(), first_re, first_im);
  phases_at(axis_.step_hz, step_re, step_im);
  // Each step depends on the one before, so a step is made for all pairs at a time.
  std::array<std::array<double, frequency_block>, most_pairs> within_re, within_im;
  PairColumn along_re, along_im;
  along_re.fill(1);
  along_im.fill(0);
  for (size_t j = 0; j < frequency_block; ++j)
    for (size_t i = 0; i < pairs; ++i) {
      const double re = along_re[i], im = along_im[i];
      within_re[i][j] = re;
      within_im[i][j] = im;
      along_re[i] = re * step_re[i] - im * step_im[i];
      along_im[i] = re * step_im[i] + im * step_re[i];
    }
  for (size_t i = 0; i < pairs; ++i) {
    const std::complex<double> along(along_re[i], along_im[i]);
    const std::complex<double> first(amplitude[i] * first_re[i], amplitude[i] * first_im[i]);
    for (size_t c = 0; c < coefficients.size(); ++c) {
      std::complex<double> base = product(coefficients[c], first);
      const size_t at = place(c, i, 0);
      const double *const re = within_re[i].data(), *const im = within_im[i].data();
      size_t k = 0;
      for (; k + frequency_block <= count_; k += frequency_block) {  // the compiler knows this length
        add_product(base, re, im, frequency_block, &re_[at + k], &im_[at + k]);
        base = product(base, along);
      }
      add_product(base, re, im, count_ - k, &re_[at + k], &im_[at + k]);
    }
  }
}

WAVETRACER_WIDE void ResponseSum::add_each(const double* delay_s, const double* amplitude, size_t pairs,
                                           std::span<const std::complex<double>> coefficients) {
  PairColumn turns, re, im;
  for (size_t k = 0; k < count_; ++k) {
    for (size_t i = 0; i < pairs; ++i) turns[i] = axis_.frequencies_hz[k] * delay_s[i];
    unit_phases(turns.data(), pairs, re.data(), im.data());
    for (size_t i = 0; i < pairs; ++i) {
      re[i] *= amplitude[i];
      im[i] *= amplitude[i];
    }
    for (size_t c = 0; c < coefficients.size(); ++c) {
      const size_t at = place(c, 0, k);
      add_product(coefficients[c], re.data(), im.data(), pairs, &re_[at], &im_[at]);
    }
  }
}

}  // namespace wavetracer
