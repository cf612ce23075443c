// SPDX-License-Identifier: Apache-2.0
// (3 + s) g(s) is a polynomial P(t), see transition.h, so g' = (P'(t) t' - g) / (3 + s). Paths over two edges take the
// function some twenty times, and it is most of their time where every fma is a call of the library.
#include "gradient/sloped_transition.hpp"

#include <array>

#include "radio/wide_loops.hpp"

namespace wavetracer {
namespace {

// Row i has the coefficients of P': the real and the imaginary one of t^(2 i + 1), then those of t^(2 i).
using Rows = std::array<std::array<double, 4>, WT_TRANSITION_ROWS>;
constexpr Rows slope_rows() {
  Rows out{};
  for (size_t i = 0; i < out.size(); ++i)
    for (size_t k = 0; k < 2; ++k) {
      if (i + 1 < out.size()) out[i][k] = static_cast<double>(2 * i + 2) * device::wt_transition_rows[i + 1][k];
      out[i][2 + k] = static_cast<double>(2 * i + 1) * device::wt_transition_rows[i][2 + k];
    }
  return out;
}
constexpr Rows rows_of_slope = slope_rows();

}  // namespace

WAVETRACER_WIDE_FMA SlopedTransition sloped_transition(double s) {
  const double t = (3.0 - s) / (3.0 + s), w = t * t;
  double p[4] = {}, slope[4] = {};
  for (size_t i = WT_TRANSITION_ROWS; i-- > 0;)
    for (size_t k = 0; k < 4; ++k) {
      p[k] = __builtin_fma(p[k], w, device::wt_transition_rows[i][k]);
      slope[k] = slope[k] * w + rows_of_slope[i][k];
    }
  SlopedTransition out;
  const double turn = -6 / ((3 + s) * (3 + s));  // t'
  for (int k = 0; k < 2; ++k) {
    out.value[k] = __builtin_fma(t, p[2 + k], p[k]) / (3.0 + s);
    out.slope[k] = ((t * slope[k] + slope[2 + k]) * turn - out.value[k]) / (3.0 + s);
  }
  return out;
}

}  // namespace wavetracer
