// SPDX-License-Identifier: Apache-2.0
// Returns the median of repeated timings and of other numbers, in the same way for every report of this program. There
// must be at least one value.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace wavetracer {

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace wavetracer
