// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of places: a ground of 200 m, and texts about them.
#pragma once
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "reference/quads.hpp"

namespace wavetracer::test {

inline const reference::Quad ground{{-100, -100, 0}, {200, 0, 0}, {0, 200, 0}};

// A list that doctest can print.
struct Texts : std::vector<std::string> {
  using std::vector<std::string>::vector;
  explicit Texts(std::vector<std::string> texts) : std::vector<std::string>(std::move(texts)) {}
  friend std::ostream& operator<<(std::ostream& out, const Texts& texts) {
    for (const std::string& text : texts) out << "\n    " << text;
    return out;
  }
};

}  // namespace wavetracer::test
