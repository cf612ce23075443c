// SPDX-License-Identifier: Apache-2.0
// The things that progress counts, such as frames.
#pragma once
#include <string>
#include <utility>

namespace wavetracer {

struct ProgressUnit {
  std::string name = {};
  // Each of them takes about as long as any other, so the first ones tell how long the rest will take. Where they are
  // not even, the time left is told after a hundredth of them.
  bool even = true;

  ProgressUnit() = default;
  ProgressUnit(const char* of) : name(of) {}
  ProgressUnit(std::string of, bool are_even) : name(std::move(of)), even(are_even) {}
  bool operator==(const ProgressUnit&) const = default;
};

}  // namespace wavetracer
