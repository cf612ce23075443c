// SPDX-License-Identifier: Apache-2.0
// The ray counts of a figure: 1, 2 and 5 times every power of ten, and the thesis' 49,000 and 90,000,000.
// A range selects from them; it does not add its ends.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/digits.hpp"

namespace wavetracer::study {

// The ray counts at which the thesis states the gain of reordering.
constexpr uint64_t claimed_few = 1000, claimed_many = 49000;
// The largest launch of the thesis (figure 6.1).
constexpr uint64_t thesis_most = 90000000;
// Number of rays of experiments that do not vary it.
constexpr uint64_t experiment_rays = claimed_many;

struct RayRange {
  uint64_t first = claimed_few, last = thesis_most;
};

// Parses "A:B", each a whole number such as 50000 or 5e4, 1,000 <= A <= B <= 10^9. Throws ConfigError.
RayRange parse_ray_range(const std::string& text);

// Returns them in ascending order. Throws ConfigError if the range contains none.
std::vector<uint64_t> ray_counts(RayRange range);

}  // namespace wavetracer::study
