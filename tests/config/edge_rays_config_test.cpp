// SPDX-License-Identifier: Apache-2.0
// trace.edge_rays in config files: what it does not go with.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

TEST_CASE("rays from edges are refused with what they would lose") {
  const std::string on = "trace.edge_rays = 500\ntrace.diffraction = true\n";
  CHECK(error_of(scene + on + ends) == "no error");
  for (const std::string& line : std::vector<std::string>{"trace.max_diffractions = 2", "trace.transmission = true",
                                                          "trace.discovery = \"beams\"", "cache.kind = \"open\""}) {
    CAPTURE(line);
    check_contains(error_of(scene + on + line + "\n" + ends),
                   "trace.edge_rays = 500 does not go with " + line + ": give trace.edge_rays = 0");
    CHECK(error_of(scene + "trace.edge_rays = 500\n" + line + "\n" + ends).find("edge_rays") == std::string::npos);
  }
  // A receiver that launches no rays has no mirrors before its tiles.
  const std::string mirrors = "trace.scattering_reflections = 2\n";
  check_contains(error_of(scene + on + "trace.scattering = true\n" + mirrors + ends),
                 "trace.edge_rays = 500 does not go with trace.scattering_reflections = 2: give trace.edge_rays = 0");
  CHECK(error_of(scene + on + mirrors + ends).find("edge_rays") == std::string::npos);  // without scattering
  check_contains(error_of(scene + "trace.edge_rays = 65537\n" + ends), "out of range");
}
