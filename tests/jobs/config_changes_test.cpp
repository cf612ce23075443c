// SPDX-License-Identifier: Apache-2.0
// Names the keys in which two configurations differ.
#include "jobs/config_changes.hpp"
#include <doctest/doctest.h>

using wavetracer::config_changes;
using Words = std::vector<std::string>;

TEST_CASE("keys that differ are named with both values, others are not") {
  const std::string was =
      "# a comment = 1\n[trace]\nrays = 1000\nseed = 1\n\n[[transmitter]]\nname = \"a\"\n[[transmitter]]\n"
      "name = \"b\"\n";
  CHECK(config_changes(was, was).empty());
  CHECK(config_changes(was,
                       "[trace]\nrays = 2000\nreuse = false\n[[transmitter]]\nname = \"a\"\n[[transmitter]]\n"
                       "name = \"c = d\"\n") ==
        Words{"trace.rays was 1000 and is 2000", "trace.reuse was not given and is false",
              "transmitter.1.name was \"b\" and is \"c = d\"", "trace.seed was 1 and is not given"});
  CHECK(config_changes("", "x = 1") == Words{"x was not given and is 1"});
}
