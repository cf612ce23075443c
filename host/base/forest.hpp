// SPDX-License-Identifier: Apache-2.0
// A union-find forest: sets of numbers that can be joined; the lowest number of a set represents it.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace wavetracer {

class Forest {
 public:
  // At first each of the numbers 0 .. count - 1 is a set of its own.
  explicit Forest(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  size_t size() const { return parent_.size(); }
  uint32_t root(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;  // each points to itself or to a lower number
};

}  // namespace wavetracer
