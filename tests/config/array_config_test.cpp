// SPDX-License-Identifier: Apache-2.0
// [[array]], [response] and several carriers: accepted and refused values, the places of errors, and reading back.
#include <doctest/doctest.h>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

TEST_CASE("every key of an array and of [response] is read, and its defaults are those of the struct") {
  const Config c = parse_config(
      scene + ends +
          "array = \"panel\"\n[[array]]\nname = \"panel\"\nrows = 8\ncolumns = 4\nvertical_spacing_m = 0.02\n"
          "horizontal_spacing_wavelengths = 0.8\ncodebook = \"dft\"\n[[array]]\nname = \"free\"\n"
          "positions_m = [[0, 0, 0], [0, 0.1, -2e-2]]\ncodebook = \"beams.csv\"\n[response]\n"
          "bandwidth_hz = 2e7\nsubcarriers = 128\ntimes = 14\ntime_step_s = 7e-5\n[radio]\n"
          "wavefront = \"plane\"\n",
      "/data/a.toml");
  REQUIRE(c.arrays.size() == 2);
  CHECK(c.receivers[0].array == "panel");
  CHECK(c.transmitters[0].array.empty());
  CHECK(c.arrays[0].rows == 8);
  CHECK(c.arrays[0].columns == 4);
  CHECK(*c.arrays[0].vertical_spacing_m == 0.02);
  CHECK_FALSE(c.arrays[0].horizontal_spacing_m);
  CHECK(c.arrays[0].vertical_spacing_wavelengths == 0.5);
  CHECK(c.arrays[0].horizontal_spacing_wavelengths == 0.8);
  CHECK(c.arrays[0].codebook == "dft");
  CHECK(c.arrays[1].positions_m == std::vector<std::array<double, 3>>{{0, 0, 0}, {0, 0.1, -2e-2}});
  CHECK(c.arrays[1].codebook == "/data/beams.csv");
  CHECK(*c.response.bandwidth_hz == 2e7);
  CHECK(c.response.subcarriers == 128);
  CHECK(c.response.times == 14);
  CHECK(c.response.time_step_s == 7e-5);
  CHECK(c.radio.wavefront.word() == "plane");
  const Config again = parse_config(resolved_config(c), "/data/a.toml");
  CHECK(resolved_config(again) == resolved_config(c));
  CHECK(again.arrays[1].positions_m == c.arrays[1].positions_m);
  CHECK_FALSE(parse_config(scene + ends + "[response]\nbandwidth_hz = 0\n", "a.toml").response.bandwidth_hz);
}

TEST_CASE("the first of several carriers is the carrier, and another radio.frequency_hz is refused") {
  const Config c = parse_config(scene + ends + "[radio]\nfrequencies_hz = [3.5e9, 28e9]\n", "a.toml");
  CHECK(c.radio.frequency_hz == 3.5e9);
  CHECK(c.radio.frequencies_hz == std::vector<double>{3.5e9, 28e9});
  CHECK(parse_config(resolved_config(c), "a.toml").radio.frequencies_hz == c.radio.frequencies_hz);
  CHECK(parse_config(scene + ends, "a.toml").radio.frequencies_hz.empty());
  check_contains(error_of(scene + ends + "[radio]\nfrequency_hz = 5.9e9\nfrequencies_hz = [3.5e9, 28e9]\n"),
                 "a.toml:9:16: radio.frequency_hz = 5900000000 is not the first of radio.frequencies_hz, 3500000000");
  check_contains(error_of(scene + ends + "[radio]\nfrequencies_hz = [3.5e9, 3.5e9]\n"),
                 "twice: name each carrier once");
  check_contains(error_of(scene + ends + "[radio]\nfrequencies_hz = [3.5e9, 10]\n"),
                 "radio.frequencies_hz[1] = 10 is out of range");
  check_contains(error_of(scene + ends + "[radio]\nfrequencies_hz = [3.5e9, \"a\"]\n"),
                 "radio.frequencies_hz[1] must be a number, not a string");
  check_contains(error_of(scene + ends + "[radio]\nfrequencies_hz = 3.5e9\n"), "must be an array of numbers");
}

TEST_CASE("arrays that contradict themselves or are not there are refused where they stand") {
  const std::string array = "[[array]]\nname = \"panel\"\n";
  check_contains(error_of(scene + ends + "array = \"panle\"\n" + array),
                 "a.toml:8:9: receiver.array = \"panle\": there is no [[array]] of this name; did you mean \"panel\"?");
  check_contains(error_of(scene + ends + array + "rows = 2\npositions_m = [[0, 0, 0]]\n"),
                 "has both positions_m and the keys of a panel");
  check_contains(error_of(scene + ends + array + "positions_m = [[0, 0, 0]]\ncodebook = \"dft\"\n"),
                 "a.toml:11:12: [[array]] \"panel\" has positions_m, but codebook = \"dft\" needs a panel");
  check_contains(error_of(scene + ends + array + "rows = 1024\ncolumns = 65\n"),
                 "has 66560 elements, and 65536 are the limit");
  check_contains(error_of(scene + ends + array + array), "array.name = \"panel\" is used twice");
  check_contains(error_of(scene + ends + array + "positions_m = [[0, 0]]\n"),
                 "array.positions_m[0] must be three numbers (m), not 2");
  check_contains(error_of(scene + ends + array + "codebook = \"dtf\"\n"), "did you mean \"dft\"?");
  check_contains(error_of(scene + ends + array + "vertical_spacing_m = 0\n"), "out of range");
}

TEST_CASE("a band that reaches below 0 Hz is refused") {
  const std::string radio = scene + ends + "[radio]\nfrequency_hz = 1e9\n", budget = "transmit_power_dbm = 20\n";
  check_contains(error_of(radio + "[response]\nbandwidth_hz = 2e9\n"),
                 "a.toml:11:16: response.bandwidth_hz = 2e+09: half of it is more than the carrier of 1e+09 Hz");
  check_contains(error_of(radio + budget + "bandwidth_hz = 3e9\n"), "radio.bandwidth_hz = 3e+09: half of it");
  check_contains(error_of(scene + ends + "[radio]\nfrequencies_hz = [6e9, 1e8]\n[response]\nbandwidth_hz = 4e8\n"),
                 "the carrier of 1e+08 Hz");
  CHECK(error_of(radio + budget + "bandwidth_hz = 1.9e9\n[response]\nbandwidth_hz = 1.9e9\n") == "no error");
}

TEST_CASE("a station has an array, which must be there") {
  const std::string station = "[[station]]\nname = \"rsu\"\nposition_m = [1, 2, 5]\narray = \"panel\"\n";
  const Config c = parse_config(scene + ends + station + "[[array]]\nname = \"panel\"\nrows = 2\n", "/data/a.toml");
  CHECK(c.stations.at(0).array == "panel");
  const std::string error = error_of(scene + ends + station + "[[array]]\nname = \"panels\"\nrows = 2\n");
  check_contains(error, "station.array = \"panel\"");
  check_contains(error, "there is no [[array]] of this name");
}
