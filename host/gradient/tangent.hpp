// SPDX-License-Identifier: Apache-2.0
// A number with its derivatives in several directions (forward differentiation). Its value is computed by the same
// operations as a double, in the same order, so it has the same bits. Comparisons and conversions look at the value
// alone. At a kink the derivative is that of the side that the value takes. No derivative is finite where the square
// root of 0 changes; one that is not finite says that there is none.
#pragma once
#include <cmath>
#include <concepts>

namespace wavetracer::tangent {

inline constexpr int lanes = 6;  // directions at a time: the coordinates of both ends of a path

// The derivatives in all directions. They are pairs, because every processor of this architecture has registers for
// pairs of doubles, and compilers do not find them in loops over numbers that they return.
struct Slopes {
  using Pair = double __attribute__((vector_size(16)));
  static constexpr int count = lanes / 2;
  Pair pairs[count];

  double operator[](int lane) const { return pairs[lane / 2][lane % 2]; }
  void set(int lane, double slope) { pairs[lane / 2][lane % 2] = slope; }
};

inline Slopes operator+(const Slopes& a, const Slopes& b) {
  return {a.pairs[0] + b.pairs[0], a.pairs[1] + b.pairs[1], a.pairs[2] + b.pairs[2]};
}
inline Slopes operator-(const Slopes& a, const Slopes& b) {
  return {a.pairs[0] - b.pairs[0], a.pairs[1] - b.pairs[1], a.pairs[2] - b.pairs[2]};
}
inline Slopes operator*(double factor, const Slopes& a) {
  const Slopes::Pair both{factor, factor};
  return {both * a.pairs[0], both * a.pairs[1], both * a.pairs[2]};
}

struct Tangent {
  double value;
  Slopes d;

  Tangent() = default;  // is not set, like a double
  constexpr Tangent(double v) : value(v), d{} {}
  Tangent(double v, const Slopes& slopes) : value(v), d(slopes) {}
  template <std::integral T>
  constexpr Tangent(T v) : Tangent(static_cast<double>(v)) {}

  template <std::integral T>
  requires(!std::same_as<T, bool>) explicit constexpr operator T() const { return static_cast<T>(value); }
};

// The function value of x, whose derivative by x is slope.
inline Tangent chained(double value, const Tangent& x, double slope) { return {value, slope * x.d}; }
inline Tangent chained(double value, const Tangent& x, double slope_x, const Tangent& y, double slope_y) {
  return {value, slope_x * x.d + slope_y * y.d};
}

// The value with the derivatives of x.
inline Tangent with_value(double value, Tangent x) {
  x.value = value;
  return x;
}

inline bool is_constant(const Tangent& x) {
  for (int i = 0; i < lanes; ++i)
    if (x.d[i] != 0) return false;
  return true;
}

inline Tangent operator-(const Tangent& a) { return chained(-a.value, a, -1); }
inline Tangent operator+(const Tangent& a, const Tangent& b) { return {a.value + b.value, a.d + b.d}; }
inline Tangent operator+(const Tangent& a, double b) { return with_value(a.value + b, a); }
inline Tangent operator+(double a, const Tangent& b) { return with_value(a + b.value, b); }
inline Tangent operator-(const Tangent& a, const Tangent& b) { return {a.value - b.value, a.d - b.d}; }
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
  for (int i = 0; i < lanes; ++i) out.d.set(i, x.d[i] == 0 ? 0 : x.d[i] * HUGE_VAL);
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
  return {std::fma(a.value, b.value, c.value), a.value * b.d + b.value * a.d + c.d};
}
inline Tangent fma(const Tangent& a, const Tangent& b, double c) {
  return chained(std::fma(a.value, b.value, c), a, b.value, b, a.value);
}

}  // namespace wavetracer::tangent
