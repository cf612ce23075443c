// The ray counts of a figure: 1, 2 and 5 times every power of ten, and the thesis' 49,000 and 90,000,000.
// A range picks from them; it does not add its ends.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/digits.hpp"

namespace wavetracer::study {

// The ray counts at which the thesis states what reordering gains.
constexpr uint64_t claimed_few = 1000, claimed_many = 49000;
// The most that the thesis launches (figure 6.1).
constexpr uint64_t thesis_most = 90000000;
// Rays of experiments that do not vary them.
constexpr uint64_t experiment_rays = claimed_many;

struct RayRange {
  uint64_t first = claimed_few, last = thesis_most;
};

// "A:B", each a whole number such as 50000 or 5e4, 1,000 <= A <= B <= 10^9. Throws ConfigError.
RayRange parse_ray_range(const std::string& text);

// Ascending. Throws ConfigError where the range holds none.
std::vector<uint64_t> ray_counts(RayRange range);

}  // namespace wavetracer::study
