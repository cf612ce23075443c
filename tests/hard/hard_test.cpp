// SPDX-License-Identifier: Apache-2.0
// Every case of the hard suite must hold.
// Each topic is a subcase; bench_hard prints all measurements.
#include <doctest/doctest.h>

#include "hard/cases.hpp"

using namespace wavetracer::test;

TEST_CASE("hard cases hold") {
  for (const HardTopic& topic : hard_topics) {
    SUBCASE(topic.name) {
      const HardCases cases = topic.run("");
      CHECK(!cases.empty());
      for (const HardCase& c : cases) {
        INFO(c.name, ": ", c.expectation, "; measured ", c.measured, " ", c.unit, ", at most ", c.tolerance);
        CHECK(c.holds());
      }
    }
  }
}
