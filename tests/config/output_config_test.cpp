// SPDX-License-Identifier: Apache-2.0
// output.paths = false in config files: what needs paths is refused with it.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

TEST_CASE("sums of links in place of paths are refused where paths are needed") {
  const std::string off = "output.paths = false\n";
  CHECK(error_of(scene + off + ends) == "no error");
  struct Case {
    std::string lines, key;
  };
  for (const Case& one : std::vector<Case>{{"radio.frequencies_hz = [3.5e9, 5.9e9]", "radio.frequencies_hz"},
                                           {"response.bandwidth_hz = 20e6", "response.bandwidth_hz"},
                                           {"trace.reception = \"sphere\"", "trace.reception"},
                                           {"trace.discover_every_s = 1", "trace.discover_every_s"}}) {
    CAPTURE(one.key);
    check_contains(error_of(scene + off + one.lines + "\n" + ends),
                   "needs the paths of links: give output.paths = true, or remove " + one.key);
    CHECK(error_of(scene + one.lines + "\n" + ends).find("output.paths") == std::string::npos);
  }
  const std::string array = "[[array]]\nname = \"panel\"\nrows = 2\ncolumns = 2\ncodebook = \"dft\"\n";
  check_contains(error_of(scene + off + ends + array), "or remove array.0.codebook");
}

TEST_CASE("lifetimes of paths are refused where paths end for other reasons, or are not kept") {
  const std::string on = "output.lifetimes = true\n";
  CHECK(error_of(scene + on + ends) == "no error");
  struct Case {
    std::string lines, key;
  };
  for (const Case& one : std::vector<Case>{
           {"output.paths = false", "output.paths"},
           {"trace.reception = \"sphere\"", "trace.reception"},
           {"trace.discovery = \"beams\"\ntrace.floor_db = -130", "trace.floor_db"},
           {"trace.diffraction = true\ntrace.diffraction_floor_db = -130", "trace.diffraction_floor_db"}}) {
    CAPTURE(one.key);
    check_contains(error_of(scene + on + one.lines + "\n" + ends), "remove output.lifetimes, or " + one.key);
    CHECK(error_of(scene + one.lines + "\n" + ends) == "no error");
  }
}
