// SPDX-License-Identifier: Apache-2.0
// Functions of tangents against differences, and their values against those of doubles.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "gradient/tangent_elementary.hpp"

using namespace wavetracer;
using tangent::Tangent;

namespace {

// A number that grows by `slope` per unit of lane 2.
Tangent growing(double value, double slope) {
  Tangent out(value);
  out.d.set(2, slope);
  return out;
}

// A function of two numbers, of tangents and of doubles, with ranges of both.
struct Function {
  const char* name;
  Tangent (*tangent)(const Tangent&, const Tangent&);
  double (*plain)(double, double);
  double low_x, high_x, low_y, high_y;
};

#define WT_BOTH(expression)                           \
  [](const Tangent& x, const Tangent& y) -> Tangent { \
    using namespace wavetracer::tangent;              \
    static_cast<void>(y);                             \
    return expression;                                \
  },                                                  \
      [](double x, double y) -> double {              \
        using namespace wavetracer::device;           \
        static_cast<void>(y);                         \
        return expression;                            \
      }

const std::vector<Function> functions{
    {"sum", WT_BOTH(x + y - 3.0 + (2.0 + x) - (4.0 - y)), -5, 5, -5, 5},
    {"product", WT_BOTH(x* y * 3.0 * (2.0 * x) * -y), -5, 5, -5, 5},
    {"quotient", WT_BOTH(x / y / 3.0 + 2.0 / y), -5, 5, 0.5, 5},
    {"sqrt", WT_BOTH(sqrt(x)), 0.1, 9, 0, 1},
    {"fabs", WT_BOTH(fabs(x)), -5, 5, 0, 1},
    {"copysign", WT_BOTH(copysign(x, y) + copysign(x, -2.0) + copysign(3.0, y)), -5, 5, -5, 5},
    {"floor", WT_BOTH(floor(x) + y), -5, 5, 0, 1},
    {"fmax", WT_BOTH(fmax(x, y) + fmax(2.0 * x, 0.5)), -5, 5, -5, 5},
    {"fmin", WT_BOTH(fmin(x, y) + fmin(2.0 * x, 0.5)), -5, 5, -5, 5},
    {"ldexp", WT_BOTH(ldexp(x, 5)), -5, 5, 0, 1},
    {"fma", WT_BOTH(fma(x, y, x) + fma(x, y, 3.0)), -5, 5, -5, 5},
    {"nearest whole", WT_BOTH(wt_nearest_whole(x) + y), -5, 5, 0, 1},
    {"cosine", WT_BOTH(wt_cos_sin(x).x), -20, 20, 0, 1},
    {"sine", WT_BOTH(wt_cos_sin(x).y), -20, 20, 0, 1},
    {"exp", WT_BOTH(wt_exp(x)), -5, 5, 0, 1},
    {"expm1", WT_BOTH(wt_expm1(x) + wt_exp_and_expm1(0.1 * x).x), -5, 5, 0, 1},
    {"log10", WT_BOTH(wt_log10(x)), 0.1, 9, 0, 1},
    {"atan2", WT_BOTH(wt_atan2(y, x)), -5, 5, -5, 5},
    {"times, real", WT_BOTH(wt_times({x, y}, {y - 6.0, x}).x), -5, 5, -5, 5},
    {"times, imaginary", WT_BOTH(wt_times({x, y}, {y - 6.0, x}).y), -5, 5, -5, 5},
    {"over, real", WT_BOTH(wt_over({x, y}, {y - 6.0, x}).x), -5, 5, -5, 5},
    {"over, imaginary", WT_BOTH(wt_over({x, y}, {y - 6.0, x}).y), -5, 5, -5, 5},
    {"size", WT_BOTH(wt_size({x, y})), -5, 5, -5, 5},
    {"root, real", WT_BOTH(wt_root({x, y}).x), -5, 5, -5, 5},
    {"root, imaginary", WT_BOTH(wt_root({x, y}).y), -5, 5, -5, 5},
    {"transition, real", WT_BOTH(wt_transition_over_root(x).x), 0, 30, 0, 1},
    {"transition, imaginary", WT_BOTH(wt_transition_over_root(x).y), 0, 30, 0, 1},
};

double slope(const Function& f, double x, double y, double dx, double dy) {
  const double h = 1e-4;
  const auto at = [&](double t) { return f.plain(x + t * dx, y + t * dy); };
  return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
}

}  // namespace

TEST_CASE("functions of tangents have the value of doubles and the slope of differences") {
  std::mt19937_64 random(5);
  for (const Function& f : functions) {
    CAPTURE(f.name);
    int apart = 0;
    for (int i = 0; i < 200; ++i) {
      const double x = std::uniform_real_distribution(f.low_x, f.high_x)(random);
      const double y = std::uniform_real_distribution(f.low_y, f.high_y)(random);
      const double dx = std::uniform_real_distribution(-1.0, 1.0)(random);
      const double dy = std::uniform_real_distribution(-1.0, 1.0)(random);
      const Tangent out = f.tangent(growing(x, dx), growing(y, dy));
      CHECK(out.value == f.plain(x, y));
      CHECK(out.d[0] == 0);
      const double expected = slope(f, x, y, dx, dy);
      apart += !(std::abs(out.d[2] - expected) < 1e-8 * (1 + std::abs(expected)));
    }
    CHECK(apart <= 2);  // a difference may go over a kink or a cut
  }
}

TEST_CASE("numbers compare by their values") {
  const Tangent a = growing(1, 5), b = growing(2, -1);
  CHECK(a < b);
  CHECK(b > a);
  CHECK(a <= 1.0);
  CHECK(1.0 >= a);
  CHECK(a == growing(1, 0));
  CHECK(a == 1.0);
  CHECK(static_cast<int>(b) == 2);
}

TEST_CASE("at the end of the range of a root a constant has the slope 0, and no other number has one") {
  using namespace wavetracer::tangent;
  CHECK(sqrt(growing(0, 0)).d[2] == 0);
  CHECK_FALSE(std::isfinite(sqrt(growing(0, 1)).d[2]));
  CHECK(wt_size({growing(0, 0), growing(0, 0)}).d[2] == 0);
  CHECK_FALSE(std::isfinite(wt_size({growing(0, 1), growing(0, 0)}).d[2]));
  CHECK(wt_root({growing(0, 0), growing(0, 0)}).x.d[2] == 0);
  CHECK_FALSE(std::isfinite(wt_root({growing(0, 1), growing(0, 0)}).x.d[2]));
  CHECK(wt_atan2(growing(0, 0), growing(0, 0)).d[2] == 0);
  CHECK_FALSE(std::isfinite(wt_atan2(growing(0, 1), growing(0, 1)).d[2]));
}

// The derivative of g is 2 j (s g - 1), which loses digits for a large s.
TEST_CASE("the slope of the transition function is that of its integral") {
  using namespace wavetracer::tangent;
  for (const double s : {0.0, 0.1, 1.0, 5.0, 20.0}) {
    const wt_double2 g = wt_transition_over_root(growing(s, 1));
    CHECK(std::abs(g.x.d[2] - -2 * s * g.y.value) < 1e-11);
    CHECK(std::abs(g.y.d[2] - 2 * (s * g.x.value - 1)) < 1e-11);
  }
}
