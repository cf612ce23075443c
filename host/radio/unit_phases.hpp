// SPDX-License-Identifier: Apache-2.0
// Many phases at once: exp(-j 2 pi turns), after whole turns are removed. There are no branches or tables, so that
// compilers compute several at a time; the error is below 5e-15.
#pragma once
#include <cstddef>

#include "radio/wide_loops.hpp"

namespace wavetracer {

// turns: below 2^50 in size.
WAVETRACER_WIDE_PART void unit_phases(const double* turns, size_t count, double* re, double* im) {
  constexpr double whole = 6755399441055744.0;                             // 1.5 2^52: a number added to it is rounded
  constexpr double quarter_of_angle = -1.5707963267948966192313216916398;  // -2 pi / 4
  for (size_t i = 0; i < count; ++i) {
    const double rounded = (turns[i] + whole) - whole;
    const double x = (turns[i] - rounded) * quarter_of_angle, x2 = x * x;  // within pi / 4
    double sine =
        x * (1 + x2 * (-1.0 / 6 +
                       x2 * (1.0 / 120 +
                             x2 * (-1.0 / 5040 +
                                   x2 * (1.0 / 362880 +
                                         x2 * (-1.0 / 39916800 + x2 * (1.0 / 6227020800.0 - x2 / 1307674368000.0)))))));
    double cosine =
        1 + x2 * (-1.0 / 2 +
                  x2 * (1.0 / 24 +
                        x2 * (-1.0 / 720 + x2 * (1.0 / 40320 + x2 * (-1.0 / 3628800 +
                                                                     x2 * (1.0 / 479001600 - x2 / 87178291200.0))))));
    for (int doubled = 0; doubled < 2; ++doubled) {
      const double twice = 2 * sine * cosine;
      cosine = cosine * cosine - sine * sine;
      sine = twice;
    }
    re[i] = cosine;
    im[i] = sine;
  }
}

}  // namespace wavetracer
