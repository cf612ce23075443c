// Every case of the hard suite must hold.
// A topic is a subcase of its own; bench_hard prints what all of them measure.
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
