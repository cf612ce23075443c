// SPDX-License-Identifier: Apache-2.0
// top_level with more instances than Oclgrind can handle: those of a city.
#include <doctest/doctest.h>

#include "passes/traffic.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("rays hit the same through the device's tree of thousands as through the host's") {
  check_hits(with_gaps(5000, 55), 20000, 55);
}
