// Sets that are joined, as a forest (union-find): the lowest number of each set stands for it.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace wavetracer {

class Forest {
 public:
  // Each of so many numbers, from 0 on, is a set of its own.
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
