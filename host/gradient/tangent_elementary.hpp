// SPDX-License-Identifier: Apache-2.0
// Functions of tangents with a derivative that is known: those of wavetracer/device/elementary.h, some of complex.h,
// and the transition function. The value is that of the device's function, and the derivative follows the chain rule.
#pragma once
#include "gradient/sloped_transition.hpp"
#include "gradient/tangent_vector.hpp"
#include "wavetracer/device/complex.h"
#include "wavetracer/device/transition.h"

namespace wavetracer::tangent {

inline Tangent wt_nearest_whole(const Tangent& x) { return device::wt_nearest_whole(x.value); }

inline wt_double2 wt_cos_sin(const Tangent& angle) {
  const device::wt_double2 turn = device::wt_cos_sin(angle.value);
  return {chained(turn.x, angle, -turn.y), chained(turn.y, angle, turn.x)};
}

inline Tangent wt_exp(const Tangent& x) {
  const double value = device::wt_exp(x.value);
  return chained(value, x, value);
}
inline wt_double2 wt_exp_and_expm1(const Tangent& x) {
  const device::wt_double2 both = device::wt_exp_and_expm1(x.value);
  return {chained(both.x, x, both.x), chained(both.y, x, both.x)};
}
inline Tangent wt_expm1(const Tangent& x) { return wt_exp_and_expm1(x).y; }

inline Tangent wt_log10(const Tangent& x) {
  return chained(device::wt_log10(x.value), x, 0.43429448190325182765 / x.value);
}

// (0, 0) has no angle; where both do not change the derivative is 0.
inline Tangent wt_atan2(const Tangent& y, const Tangent& x) {
  const double value = device::wt_atan2(y.value, x.value);
  if (is_constant(x) && is_constant(y)) return value;
  const double square = x.value * x.value + y.value * y.value;
  return chained(value, y, x.value / square, x, -y.value / square);
}

// Pairs of doubles as the device has them.
inline device::wt_double2 value_of(const wt_double2& a) { return {a.x.value, a.y.value}; }

// The complex function value of a, whose complex derivative is slope.
inline wt_double2 chained_complex(device::wt_double2 value, const wt_double2& a, device::wt_double2 slope) {
  return {chained(value.x, a.x, slope.x, a.y, -slope.y), chained(value.y, a.x, slope.y, a.y, slope.x)};
}

inline wt_double2 wt_times(const wt_double2& a, const wt_double2& b) {
  const device::wt_double2 value = device::wt_times(value_of(a), value_of(b));
  return {{value.x, a.x.value * b.x.d + b.x.value * a.x.d - (a.y.value * b.y.d + b.y.value * a.y.d)},
          {value.y, a.x.value * b.y.d + b.y.value * a.x.d + (a.y.value * b.x.d + b.x.value * a.y.d)}};
}

// a / b; its derivative is (a' - b' a / b) / b.
inline wt_double2 wt_over(const wt_double2& a, const wt_double2& b) {
  const device::wt_double2 quotient = device::wt_over(value_of(a), value_of(b));
  const device::wt_double2 share = device::wt_over({1, 0}, value_of(b));
  const wt_double2 by_a = chained_complex(quotient, a, share);
  const wt_double2 by_b = chained_complex(quotient, b, device::wt_times(-quotient, share));
  return {with_value(quotient.x, by_a.x + by_b.x), with_value(quotient.y, by_a.y + by_b.y)};
}

// |a| has no derivative at 0, unless a does not change there.
inline Tangent wt_size(const wt_double2& a) {
  const double size = device::wt_size(value_of(a));
  if (is_constant(a.x) && is_constant(a.y)) return size;
  return chained(size, a.x, a.x.value / size, a.y, a.y.value / size);
}

// The derivative is a' / (2 root). The root of 0 has none, unless a does not change there.
inline wt_double2 wt_root(const wt_double2& a) {
  const device::wt_double2 root = device::wt_root(value_of(a));
  if (is_constant(a.x) && is_constant(a.y)) return {root.x, root.y};
  return chained_complex(root, a, device::wt_over({0.5, 0}, root));
}

inline wt_double2 wt_transition_over_root(const Tangent& argument) {
  const SlopedTransition g = sloped_transition(argument.value);
  return {chained(g.value.x, argument, g.slope.x), chained(g.value.y, argument, g.slope.y)};
}

}  // namespace wavetracer::tangent
