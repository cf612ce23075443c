// SPDX-License-Identifier: Apache-2.0
// A number with its derivatives in several directions (forward differentiation). Its value is computed by the same
// operations as a double, in the same order, so it has the same bits. Comparisons and conversions look at the value
// alone. At a kink the derivative is that of the side that the value takes. No derivative is finite where the square
// root of 0 changes; one that is not finite says that there is none.
#pragma once
#include <array>
#include <cmath>
#include <concepts>

namespace wavetracer::tangent {

inline constexpr int lanes = 6;  // directions at a time: the coordinates of both ends of a path

struct Tangent {
  double value;
  std::array<double, lanes> d;

  Tangent() = default;  // is not set, like a double
  constexpr Tangent(double v) : value(v), d{} {}
  template <std::integral T>
  constexpr Tangent(T v) : Tangent(static_cast<double>(v)) {}

  template <std::integral T>
  requires(!std::same_as<T, bool>) explicit constexpr operator T() const { return static_cast<T>(value); }
};

// The function value of x, whose derivative by x is slope.
inline Tangent chained(double value, const Tangent& x, double slope) {
  Tangent out;
  out.value = value;
  for (int i = 0; i < lanes; ++i) out.d[i] = slope * x.d[i];
  return out;
}
inline Tangent chained(double value, const Tangent& x, double slope_x, const Tangent& y, double slope_y) {
  Tangent out;
  out.value = value;
  for (int i = 0; i < lanes; ++i) out.d[i] = slope_x * x.d[i] + slope_y * y.d[i];
  return out;
}

// The value with the derivatives of x.
inline Tangent with_value(double value, Tangent x) {
  x.value = value;
  return x;
}

inline bool is_constant(const Tangent& x) {
  for (const double d : x.d)
    if (d != 0) return false;
  return true;
}

inline Tangent operator-(const Tangent& a) { return chained(-a.value, a, -1); }
inline Tangent operator+(const Tangent& a, const Tangent& b) {
  Tangent out;
  out.value = a.value + b.value;
  for (int i = 0; i < lanes; ++i) out.d[i] = a.d[i] + b.d[i];
  return out;
}
inline Tangent operator+(const Tangent& a, double b) { return with_value(a.value + b, a); }
inline Tangent operator+(double a, const Tangent& b) { return with_value(a + b.value, b); }
inline Tangent operator-(const Tangent& a, const Tangent& b) {
  Tangent out;
  out.value = a.value - b.value;
  for (int i = 0; i < lanes; ++i) out.d[i] = a.d[i] - b.d[i];
  return out;
}
inline Tangent operator-(const Tangent& a, double b) { return with_value(a.value - b, a); }
inline Tangent operator-(double a, const Tangent& b) { return chained(a - b.value, b, -1); }
inline Tangent operator*(const Tangent& a, const Tangent& b) {
  return chained(a.value * b.value, a, b.value, b, a.value);
}
inline Tangent operator*(const Tangent& a, double b) { return chained(a.value * b, a, b); }
inline Tangent operator*(double a, const Tangent& b) { return chained(a * b.value, b, a); }
inline Tangent operator/(const Tangent& a, const Tangent& b) {
  const double quotient = a.value / b.value, share = 1 / b.value;
  return chained(quotient, a, share, b, -quotient * share);
}
inline Tangent operator/(const Tangent& a, double b) { return chained(a.value / b, a, 1 / b); }
inline Tangent operator/(double a, const Tangent& b) {
  const double quotient = a / b.value;
  return chained(quotient, b, -quotient / b.value);
}
inline Tangent& operator+=(Tangent& a, const Tangent& b) { return a = a + b; }
inline Tangent& operator-=(Tangent& a, const Tangent& b) { return a = a - b; }
inline Tangent& operator*=(Tangent& a, const Tangent& b) { return a = a * b; }

inline bool operator<(const Tangent& a, const Tangent& b) { return a.value < b.value; }
inline bool operator<(const Tangent& a, double b) { return a.value < b; }
inline bool operator<(double a, const Tangent& b) { return a < b.value; }
inline bool operator>(const Tangent& a, const Tangent& b) { return a.value > b.value; }
inline bool operator>(const Tangent& a, double b) { return a.value > b; }
inline bool operator>(double a, const Tangent& b) { return a > b.value; }
inline bool operator<=(const Tangent& a, const Tangent& b) { return a.value <= b.value; }
inline bool operator<=(const Tangent& a, double b) { return a.value <= b; }
inline bool operator<=(double a, const Tangent& b) { return a <= b.value; }
inline bool operator>=(const Tangent& a, const Tangent& b) { return a.value >= b.value; }
inline bool operator>=(const Tangent& a, double b) { return a.value >= b; }
inline bool operator>=(double a, const Tangent& b) { return a >= b.value; }
inline bool operator==(const Tangent& a, const Tangent& b) { return a.value == b.value; }
inline bool operator==(const Tangent& a, double b) { return a.value == b; }

using std::copysign;
using std::fabs;
using std::floor;
using std::fma;
using std::fmax;
using std::fmin;
using std::ldexp;
using std::sqrt;

// At 0 the derivative is 0 where x does not change, and infinite elsewhere.
inline Tangent sqrt(const Tangent& x) {
  const double root = std::sqrt(x.value);
  if (root > 0) return chained(root, x, 0.5 / root);
  Tangent out;
  out.value = root;
  for (int i = 0; i < lanes; ++i) out.d[i] = x.d[i] == 0 ? 0 : x.d[i] * HUGE_VAL;
  return out;
}
inline Tangent fabs(const Tangent& x) { return chained(std::fabs(x.value), x, std::signbit(x.value) ? -1 : 1); }
inline Tangent copysign(const Tangent& size, double sign) {
  const double value = std::copysign(size.value, sign);
  return chained(value, size, std::signbit(value) == std::signbit(size.value) ? 1 : -1);
}
inline Tangent copysign(const Tangent& size, const Tangent& sign) { return copysign(size, sign.value); }
inline double copysign(double size, const Tangent& sign) { return std::copysign(size, sign.value); }
inline double floor(const Tangent& x) { return std::floor(x.value); }
// The value is that of the library, which decides what is larger; of two that are equal it is the first one.
inline Tangent fmax(const Tangent& a, const Tangent& b) {
  return with_value(std::fmax(a.value, b.value), b.value > a.value || std::isnan(a.value) ? b : a);
}
inline Tangent fmin(const Tangent& a, const Tangent& b) {
  return with_value(std::fmin(a.value, b.value), b.value < a.value || std::isnan(a.value) ? b : a);
}
inline Tangent ldexp(const Tangent& x, int exponent) {
  return chained(std::ldexp(x.value, exponent), x, std::ldexp(1.0, exponent));
}
inline Tangent fma(const Tangent& a, const Tangent& b, const Tangent& c) {
  Tangent out;
  out.value = std::fma(a.value, b.value, c.value);
  for (int i = 0; i < lanes; ++i) out.d[i] = a.value * b.d[i] + b.value * a.d[i] + c.d[i];
  return out;
}
inline Tangent fma(const Tangent& a, const Tangent& b, double c) {
  return chained(std::fma(a.value, b.value, c), a, b.value, b, a.value);
}

}  // namespace wavetracer::tangent
