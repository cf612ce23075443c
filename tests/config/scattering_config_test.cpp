// SPDX-License-Identifier: Apache-2.0
// trace.scattering_diffraction in config files: what it needs.
#include <doctest/doctest.h>

#include <string>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

TEST_CASE("edges beside tiles are refused where there would be none") {
  const std::string key = "trace.scattering_diffraction = true\n", edges = "trace.diffraction = true\n",
                    tiles = "trace.scattering = true\ntrace.scattering_reflections = 1\n";
  CHECK(error_of(scene + key + edges + tiles + ends) == "no error");
  check_contains(error_of(scene + key + tiles + ends),
                 "trace.scattering_diffraction = true needs trace.diffraction = true");
  check_contains(error_of(scene + key + edges + ends), "they are true, false and 0");
  check_contains(error_of(scene + key + edges + "trace.scattering = true\n" + ends), "they are true, true and 0");
}
