// SPDX-License-Identifier: Apache-2.0
// Times of questions to a server, and what they are shown by.
#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace wavetracer::bench {

// Returns the smallest value that at most the share 1 - `share` of the values exceeds.
inline double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<size_t>(last, 1) - 1];
}

// Returns what the action returns, and adds its seconds.
template <class Action>
auto timed(std::vector<double>& seconds, const Action& action) {
  const auto start = std::chrono::steady_clock::now();
  auto out = action();
  seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return out;
}

}  // namespace wavetracer::bench
