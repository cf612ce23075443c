// SPDX-License-Identifier: Apache-2.0
// [[radar]] in config files: what a waveform refuses, and what radars do not go with.
#include <doctest/doctest.h>

#include <string>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

TEST_CASE("radars: keys that contradict each other, and names of groups") {
  const auto error = [](const std::string& keys) {
    return error_of(scene + ends + "[[radar]]\nname = \"front\"\n" + keys + "\n");
  };
  CHECK(error("") == "no error");
  CHECK(error("interval_s = 25e-6\nnoise_figure_db = 12\nseed = 3\npower_dbm = 12\nkind = \"bistatic\"") == "no error");
  check_contains(error("interval_s = 10e-6"), "front\" has interval_s = 1e-05, shorter than a chirp of 2e-05 s");
  check_contains(error("bandwidth_hz = 12e9"), "half of it is more than the carrier of 5.9e+09 Hz");
  CHECK(error("samples = 200\nbandwidth_hz = 10e6") == "no error");  // just the chirp
  check_contains(
      error("samples = 300\nbandwidth_hz = 10e6"),
      "front\" has samples = 300 and bandwidth_hz = 1e+07, so it would hear echoes up to 3e-05 s late, longer "
      "than its chirp, chirp_s = 2e-05");
  check_contains(error("seed = 3"), "has a seed, but no noise: give noise_figure_db");
  check_contains(error("guard = 6"), "guard = 6 and training = 6");
  check_contains(error("training = 70"), "a square of 141 x 141 cells, but its map has 128 x 256");
  check_contains(error("chirps = 1"), "radar.chirps");
  check_contains(error("range_window = \"kaiser\""), "blackman");
  check_contains(error("false_alarm = 0.0"), "radar.false_alarm");
  check_contains(error("[output]\npaths = false"), "[[radar]] needs the paths of links");
  check_contains(error_of(scene + ends + "[[radar]]\nname = \"a/b\"\n"), "give one of letters, digits, - and _");
  check_contains(error_of(scene + ends + "[[radar]]\nname = \"a\"\n[[radar]]\nname = \"a\"\n"), "is used twice");
  check_contains(error_of(scene + ends + "[[radar]]\nchirps = 12\n"), "[[radar]] has no name");
}
