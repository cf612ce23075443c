// SPDX-License-Identifier: Apache-2.0
// Meaningless numbers are refused where they appear: every key that takes numbers has bounds.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "config/field_table.hpp"
#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

TEST_CASE("every key that takes numbers takes finite ones alone, within bounds") {
  for (const config::Table& table : config::tables())
    for (const config::Field& field : table.fields) {
      const std::string words = config::accepted(field);
      if (words.find("number") == std::string::npos && words.find("[x, y, z]") == std::string::npos) continue;
      CAPTURE(table.name);
      CAPTURE(field.name);
      CHECK(field.range.lower > -1e13);
      // Inf: there is no upper limit, as the doc says.
      CHECK((field.range.upper < 1e13 || std::isinf(field.range.upper)));
    }
}

TEST_CASE("speeds of light, places beyond all coordinates and times beyond all calendars are refused") {
  check_contains(error_of(scene + ends + "velocity_m_s = [0, 1e308, 0]\n"),
                 "a.toml:8:16: receiver.velocity_m_s[1] = 1e+308 is out of range: it must be a number from -100000000");
  check_contains(error_of(scene + ends + "velocity_m_s = [3e8, 0, 0]\n"), "out of range");
  check_contains(error_of(scene + ends + "orientation_deg = [1e300, 0, 0]\n"), "out of range");
  check_contains(error_of(scene + ends + "[[receiver]]\nname = \"n\"\nposition_m = [0, 0, 1e20]\n"),
                 "receiver.position_m[2] = 1e+20 is out of range: it must be a number from -1000000000 to 1000000000");
  check_contains(error_of(scene + ends + "[time]\nstart_s = -1e300\n"), "time.start_s = -1e+300 is out of range");
}
