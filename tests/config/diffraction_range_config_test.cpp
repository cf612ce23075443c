// SPDX-License-Identifier: Apache-2.0
// trace.diffraction_range_db in config files: what it does not go with, and when "auto" leaves paths out.
#include <doctest/doctest.h>

#include <optional>
#include <string>
#include <vector>

#include "config/diffraction_range.hpp"
#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

namespace {

const std::string bends = "trace.diffraction = true\n";
const std::vector<std::string> obstacles{"radio.frequencies_hz = [1e9, 2e9]", "output.lifetimes = true",
                                         "trace.reception = \"sphere\"\ntrace.sphere_radius_m = 1",
                                         "trace.discovery = \"beams\""};

}  // namespace

TEST_CASE("a range below the strongest path is refused with what it would falsify") {
  const std::string on = "trace.diffraction_range_db = 45\n";
  CHECK(error_of(scene + bends + on + ends) == "no error");
  for (const std::string& line : obstacles) {
    CAPTURE(line);
    const std::string key = line.substr(0, line.find(' '));
    check_contains(error_of(scene + bends + on + line + "\n" + ends),
                   "trace.diffraction_range_db = 45 does not go with " + key + " = ");
    CHECK(error_of(scene + bends + "trace.diffraction_range_db = 400\n" + line + "\n" + ends)
              .find("diffraction_range_db") == std::string::npos);
    CHECK(error_of(scene + on + line + "\n" + ends).find("does not go with") == std::string::npos);
  }
  check_contains(error_of(scene + bends + "trace.diffraction_range_db = 29\n" + ends), "out of range");
  check_contains(error_of(scene + bends + "trace.diffraction_range_db = 401\n" + ends), "out of range");
}

TEST_CASE("with \"auto\" paths are left out where only sums are written, and nothing forbids it") {
  const auto range = [](const std::string& lines) {
    const Config config = parse_config(scene + lines + ends, "a.toml", {});
    return config::diffraction_range_of(config, config.trace);
  };
  const std::string sums = "output.paths = false\n", none = "trace.diffraction_range_db = 400\n";
  CHECK(range(bends + sums) == config::automatic_range_db);
  CHECK(range(bends + sums + "trace.diffraction_range_db = \"auto\"\n") == config::automatic_range_db);
  CHECK(range(bends) == std::nullopt);
  CHECK(range(sums) == std::nullopt);
  CHECK(range(bends + sums + none) == std::nullopt);
  CHECK(range(bends + none) == std::nullopt);
  CHECK(range(bends + "trace.diffraction_range_db = 60\n") == 60);
  CHECK(range(bends + sums + "trace.discovery = \"beams\"\n") == std::nullopt);
}
