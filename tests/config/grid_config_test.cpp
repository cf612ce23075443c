// SPDX-License-Identifier: Apache-2.0
// [[receiver_grid]]: accepted and refused values, the places of errors, and that a resolved config reads back the same.
// Texts are written here by hand; lines and columns are counted in them.
#include <doctest/doctest.h>

#include "config/texts.hpp"

using namespace wavetracer;
using test::check_contains;
using test::ends;
using test::error_of;
using test::scene;

namespace {

const std::string grid = "[[receiver_grid]]\nname = \"map\"\n";
const std::string transmitter = "[[transmitter]]\nname = \"t\"\nposition_m = [0, 0, 6]\n";

}  // namespace

TEST_CASE("every key of a grid is read, and its defaults are those of the struct") {
  const Config c = parse_config(scene + ends + grid +
                                    "x_min_m = -10\nx_max_m = 20.5\ny_min_m = 0\ny_max_m = 1e3\nstep_m = 2.5\n"
                                    "height_m = 1\nabove = \"ground\"\nantenna = \"dipole\"\npolarization = \"VH\"\n"
                                    "orientation_deg = [90, 0, 0]\n[[receiver_grid]]\nname = \"plain\"\n",
                                "/data/a.toml");
  REQUIRE(c.receiver_grids.size() == 2);
  const ReceiverGridConfig &g = c.receiver_grids[0], &plain = c.receiver_grids[1];
  CHECK(g.name == "map");
  CHECK(*g.x_min_m == -10);
  CHECK(*g.x_max_m == 20.5);
  CHECK(*g.y_min_m == 0);
  CHECK(*g.y_max_m == 1000);
  CHECK(g.step_m == 2.5);
  CHECK(g.height_m == 1);
  CHECK(g.above.word() == "ground");
  CHECK(g.antenna == "dipole");
  CHECK(g.polarization.word() == "VH");
  CHECK(g.orientation_deg == std::array<double, 3>{90, 0, 0});
  CHECK_FALSE((plain.x_min_m || plain.x_max_m || plain.y_min_m || plain.y_max_m));
  CHECK(plain.above.word() == "zero");
  CHECK(plain.step_m == ReceiverGridConfig{}.step_m);
}

TEST_CASE("the resolved config of grids reads back the same") {
  const Config c = parse_config(scene + ends + grid + "x_min_m = 0.1\n", "/data/a.toml");
  const Config d = parse_config(c.text, "/elsewhere/b.toml");
  CHECK(d.text == c.text);
  REQUIRE(d.receiver_grids.size() == 1);
  CHECK(*d.receiver_grids[0].x_min_m == 0.1);
  CHECK_FALSE(d.receiver_grids[0].x_max_m.has_value());
}

TEST_CASE("corners in degrees are read, and saved as they were given") {
  const Config c = parse_config(scene + ends + grid + "south_west_wgs84 = [48.137, 11.575]\nx_max_m = 20\n" +
                                    "[[receiver_grid]]\nname = \"other\"\nnorth_east_wgs84 = [-90, 180]\n",
                                "/data/a.toml");
  const Config d = parse_config(c.text, "/elsewhere/b.toml");
  CHECK(d.text == c.text);
  REQUIRE(d.receiver_grids.size() == 2);
  const ReceiverGridConfig &g = d.receiver_grids[0], &other = d.receiver_grids[1];
  CHECK(g.south_west_wgs84 == std::array<double, 2>{48.137, 11.575});
  CHECK_FALSE(g.north_east_wgs84.has_value());
  CHECK_FALSE((g.x_min_m || g.y_min_m));
  CHECK(*g.x_max_m == 20);
  CHECK(other.north_east_wgs84 == std::array<double, 2>{-90, 180});
}

TEST_CASE("corners in degrees that exclude a border or are no place on the earth") {
  check_contains(error_of(scene + ends + grid + "x_min_m = 0\nsouth_west_wgs84 = [48, 11]\n"),
                 "a.toml:11:20: [[receiver_grid]] has both x_min_m and south_west_wgs84: remove one of them");
  check_contains(error_of(scene + ends + grid + "y_min_m = 0\nsouth_west_wgs84 = [48, 11]\n"),
                 "has both y_min_m and south_west_wgs84");
  check_contains(error_of(scene + ends + grid + "north_east_wgs84 = [48, 11]\nx_max_m = 0\n"),
                 "a.toml:11:11: [[receiver_grid]] has both x_max_m and north_east_wgs84");
  check_contains(error_of(scene + ends + grid + "north_east_wgs84 = [48, 11]\ny_max_m = 0\n"),
                 "has both y_max_m and north_east_wgs84");
  check_contains(error_of(scene + ends + grid + "south_west_wgs84 = [95, 11]\n"),
                 "a.toml:10:20: latitude 95 and longitude 11 are no place on the earth");
  check_contains(error_of(scene + ends + grid + "north_east_wgs84 = [48, -181]\n"),
                 "a.toml:10:20: latitude 48 and longitude -181 are no place on the earth");
  check_contains(error_of(scene + ends + grid + "north_east_wgs84 = [48, 11, 6]\n"),
                 "receiver_grid.north_east_wgs84 must be two numbers from -1000000 to 1000000 (degrees), not 3");
}

TEST_CASE("a grid takes the place of receivers") {
  CHECK(error_of(scene + transmitter + grid) == "no error");
  check_contains(error_of(scene + transmitter), "no [[receiver]]: add one");
  check_contains(error_of(scene + grid), "no [[transmitter]]: add one");
}

TEST_CASE("values that are no such thing, with their place") {
  check_contains(error_of(scene + ends + "[[receiver_grid]]\nstep_m = 5\n"),
                 "a.toml:8:1: [[receiver_grid]] has no name");
  check_contains(error_of(scene + ends + grid + "step_m = 0\n"),
                 "a.toml:10:10: receiver_grid.step_m = 0 is out of range");
  check_contains(error_of(scene + ends + grid + "above = \"sea\"\n"), "a.toml:10:9: receiver_grid.above = \"sea\"");
  check_contains(error_of(scene + ends + grid + "stepp_m = 1\n"), "did you mean \"receiver_grid.step_m\"?");
  check_contains(error_of(scene + ends + grid + "x_min_m = inf\n"), "receiver_grid.x_min_m = inf is out of range");
  check_contains(error_of(scene + ends + "[receiver_grid]\nname = \"map\"\n"), "write [[receiver_grid]]");
  check_contains(error_of(scene + ends + grid + grid), "a.toml:11:8: receiver_grid.name = \"map\" is used twice");
}

TEST_CASE("a vertical plane is read, and saved as it was given") {
  const Config c = parse_config(scene + ends + grid + "from_m = [1, 2]\nto_m = [4, 6.5]\nz_min_m = -1\nstep_m = 0.5\n",
                                "/data/a.toml");
  const Config d = parse_config(c.text, "/elsewhere/b.toml");
  CHECK(d.text == c.text);
  REQUIRE(d.receiver_grids.size() == 1);
  const ReceiverGridConfig& g = d.receiver_grids[0];
  CHECK(g.vertical());
  CHECK(g.from_m == std::array<double, 2>{1, 2});
  CHECK(g.to_m == std::array<double, 2>{4, 6.5});
  CHECK(g.z_min_m == -1);
  CHECK_FALSE((g.z_max_m || g.height_m || g.x_min_m));
  CHECK_FALSE(parse_config(scene + ends + grid, "/data/a.toml").receiver_grids[0].vertical());
}

TEST_CASE("keys of a vertical plane and of a horizontal grid are refused together, with those that belong together") {
  const std::string plane = grid + "from_m = [1, 2]\nto_m = [4, 6]\n";
  for (const auto& [line, at, key] : {std::array<std::string, 3>{"x_min_m = 0\n", "12:11", "x_min_m"},
                                      {"y_max_m = 9\n", "12:11", "y_max_m"},
                                      {"height_m = 1.5\n", "12:12", "height_m"},
                                      {"heights_m = [1, 2]\n", "12:13", "heights_m"},
                                      {"above = \"ground\"\n", "12:9", "above"},
                                      {"south_west_wgs84 = [48, 11]\n", "12:20", "south_west_wgs84"}}) {
    const std::string said = error_of(scene + ends + plane + line);
    CAPTURE(said);
    check_contains(said,
                   "a.toml:" + at + ": [[receiver_grid]] has from_m, to_m, of a vertical plane, and " + key +
                       ", of a horizontal grid: remove one or the other. A vertical plane has from_m, to_m, z_min_m, ");
  }
  check_contains(error_of(scene + ends + grid + "z_max_m = 9\nx_min_m = 1\n"),
                 "has z_max_m, of a vertical plane, and x_min_m");
  check_contains(error_of(scene + ends + grid + "z_max_m = 9\n"),
                 "a.toml:10:11: [[receiver_grid]] has z_max_m and no from_m");
  check_contains(error_of(scene + ends + grid + "from_m = [0, 0]\n"),
                 "has from_m and no to_m: a vertical plane stands between");
  check_contains(error_of(scene + ends + grid + "from_m = [3, 4]\nto_m = [3, 4]\n"),
                 "a.toml:11:8: [[receiver_grid]] has from_m = to_m = [3, 4], so its plane has no direction");
  check_contains(error_of(scene + ends + grid + "from_m = [3]\n"), "receiver_grid.from_m must be two numbers");
}

TEST_CASE("several heights make a grid of each, which are saved as such") {
  const Config c = parse_config(scene + ends + "[[receiver_grid]]\nname = \"first\"\n" + grid +
                                    "heights_m = [1.5, 4, -0.25]\nx_min_m = 3\nabove = \"ground\"\n"
                                    "[[receiver_grid]]\nname = \"last\"\nheights_m = [7]\n",
                                "/data/a.toml", {"receiver_grid.2.step_m=9"});
  const auto check = [](const Config& config) {
    const auto& grids = config.receiver_grids;
    REQUIRE(grids.size() == 5);
    const char* names[] = {"first", "map@1.5", "map@4", "map@-0.25", "last@7"};
    for (size_t k = 0; k < 5; ++k) {
      CHECK(grids[k].name == names[k]);
      CHECK(grids[k].heights_m.empty());
    }
    CHECK_FALSE(grids[0].height_m.has_value());
    CHECK(grids[1].height_m == 1.5);
    CHECK(grids[2].height_m == 4);
    CHECK(grids[3].height_m == -0.25);
    CHECK(grids[3].x_min_m == 3);
    CHECK(from_ground(grids[3].above));
    CHECK(grids[4].step_m == 9);
  };
  check(c);
  const Config d = parse_config(c.text, "/elsewhere/b.toml");
  check(d);
  CHECK(d.text == c.text);
}

TEST_CASE("heights that exclude each other") {
  check_contains(error_of(scene + ends + grid + "heights_m = [1, 2]\nheight_m = 1.5\n"),
                 "a.toml:11:12: [[receiver_grid]] has both height_m and heights_m: remove one of them");
  check_contains(error_of(scene + ends + grid + "heights_m = [1, 2, 1]\n"),
                 "a.toml:10:13: receiver_grid.heights_m has 1 m twice: remove one of them");
}
