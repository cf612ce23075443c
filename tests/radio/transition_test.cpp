// SPDX-License-Identifier: Apache-2.0
// The transition function against values of 60 digits and an independent quadrature.
// Values: mpmath 1.3, s = sqrt(x), F = s sqrt(pi) expj(pi/4) exp(u u) erfc(u), u = expj(pi/4) s; from 1e8 on the series
// F = sum over k of (2k-1)!! (j / 2x)^k.
#include "radio/transition.hpp"

#include <doctest/doctest.h>

#include "radio/fresnel.hpp"

using namespace wavetracer;
using Complex = std::complex<double>;

TEST_CASE("transition function: values from mpmath, x from 1e-12 to 1e12") {
  struct Known {
    double x, re, im;
  };
  for (const Known& k : {Known{1e-12, 1.2533141373142469e-6, 1.2533121373167536e-6},
                         {1e-6, 0.0012533128853340696, 0.0012513153906290114},
                         {0.001, 0.039594953226235711, 0.037672886959129088},
                         {0.1, 0.36810356780048205, 0.23445296229247305},
                         {0.5, 0.67676270669041338, 0.26823295338462845},
                         {1, 0.80952548174740884, 0.23219939005526461},
                         {3, 0.94724225874107055, 0.13257826183062645},
                         {8.99, 0.99151928389343023, 0.05340455034894219},
                         {9.01, 0.99155400136190836, 0.053294560841530734},
                         {10, 0.99304112701162634, 0.048351495561654347},
                         {100, 0.99992506546336361, 0.0049981279426342198},
                         {1e4, 0.99999999250000066, 4.9999998125000295e-5},
                         {1e8, 0.99999999999999992, 4.9999999999999981e-9},
                         {1e12, 1.0, 5.0e-13}}) {
    CAPTURE(k.x);
    CHECK(std::abs(transition(k.x) - Complex{k.re, k.im}) < 1e-14 * std::abs(Complex{k.re, k.im}));
  }
  CHECK(transition(0) == 0.0);
  CHECK(std::abs(transition_over_root(0) - std::polar(std::sqrt(std::numbers::pi), std::numbers::pi / 4)) < 1e-15);
}

TEST_CASE("transition function: its integral by quadrature") {
  const Complex j{0, 1};
  for (double s = 0.01; s < 12; s += 0.037) {
    CAPTURE(s);
    const Complex exact = 2.0 * j * std::exp(j * s * s) * test::fresnel_tail(s);
    CHECK(std::abs(transition_over_root(s) - exact) < 1e-10 * std::abs(exact));
  }
}
