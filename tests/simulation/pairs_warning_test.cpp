// SPDX-License-Identifier: Apache-2.0
// Pairs of ways to edges and tiles: the warning before a frame that may have too many.
#include <doctest/doctest.h>

#include "contains.hpp"
#include "simulation/scattered_edges.hpp"

using namespace wavetracer;

TEST_CASE("pairs that may be too many are told before the frame, with what to do") {
  CHECK(warning_of_pairs(2, 1000, 1 << 20, false) == "");
  const std::string told = warning_of_pairs(100, 10000, 100000, false);
  CHECK(contains(told,
                 "100 ends that launch rays, 10,000 edges and 100,000 tiles may be more than 68,719,476,736 pairs"));
  CHECK(contains(told, "give trace.scattering_floor_db"));
  CHECK(warning_of_pairs(100, 10000, 100000, true) == "");
  const uint64_t most = ~uint64_t{0};
  CHECK(warning_of_pairs(most, most, most, false) != "");  // their product overflows
}
