// SPDX-License-Identifier: Apache-2.0
// Tests positions in degrees and heights above the ground: ends, mounts, tracks and trajectories, against numbers of
// pyproj 3.7.2 (EPSG:4326 to EPSG:32632) and the plane of the ground.
#include <fstream>

#include "scene/load.hpp"
#include "simulation/place_warnings.hpp"
#include "simulation/run.hpp"
#include "simulation/world.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The UTM coordinates, zone 32, of 48.137 degrees north, 11.575 degrees east.
constexpr double easting_m = 691567.326384, northing_m = 5334734.330482;
constexpr double slope = 0.1;

// A hill side of 2 x 2 km that rises eastward from z = 500 at the place, and a house on it whose floor is 3 m below.
class HillSide {
 public:
  HillSide() : file_({Part{{{{-1000, -1000, 400}, {2000, 0, 200}, {0, 2000, 0}}}}, Part{house()}}) {
    std::ofstream(file_.path().parent_path() / "georeference.json") << fmt::format(
        "{{\"projection\": \"+proj=utm +zone=32 +ellps=WGS84 +units=m\", \"offset_m\": [{:.6f}, {:.6f}]}}", -easting_m,
        -northing_m);
  }
  Config config(const std::string& text) const {
    return parse_config(fmt::format("[scene]\nfile = \"{}\"\n{}", file_.path().string(), text), "test.toml", {});
  }
  World world(const std::string& text) const {
    const Config parsed = config(text);
    return make_world(parsed, load_scene(parsed));
  }

 private:
  static std::vector<Quad> house() { return reference::box_walls({100, 100, 507}, {120, 120, 520}); }
  SceneFile file_;
};

constexpr const char* receiver = "[[receiver]]\nname = \"rx\"\nposition_m = [0, 0, 600]\n";

std::string problem(const std::string& text) {
  try {
    HillSide().world(text);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

void check_place(const std::array<double, 3>& found, const glm::dvec3& wanted, double tolerance_m = 1e-3) {
  for (size_t i = 0; i < 3; ++i) {
    CAPTURE(i);
    CAPTURE(found[i]);
    CHECK(std::abs(found[i] - wanted[static_cast<int>(i)]) < tolerance_m);
  }
}

}  // namespace

TEST_CASE("ends in degrees and above the ground, the floor of a house not taken for it") {
  const World world = HillSide().world(
      "[[station]]\nname = \"s\"\nposition_wgs84 = [48.137, 11.575, 6]\n"
      "[[transmitter]]\nname = \"north\"\nposition_wgs84 = [48.138, 11.575, 2]\n"
      "[[transmitter]]\nname = \"house\"\nposition_m = [110, 110, 20]\nabove = \"ground\"\n"
      "[[transmitter]]\nname = \"zero\"\nposition_m = [110, 110, 20]\n"
      "[[receiver]]\nname = \"rx\"\nposition_m = [-200, 5, 1.5]\nabove = \"ground\"\n");
  const std::vector<RadioEnd>& tx = world.transmitters.ends;
  check_place(tx[0].position_m, {-3.722323, 111.136340, 500 + slope * (-3.722323) + 2});
  check_place(tx[1].position_m, {110, 110, 531});
  check_place(tx[2].position_m, {110, 110, 20});
  check_place(tx[3].position_m, {0, 0, 506});
  check_place(world.receivers.ends[0].position_m, {-200, 5, 481.5});
  check_place(world.receivers.ends[1].position_m, {0, 0, 506});
}

TEST_CASE("a track in degrees follows the ground, an antenna above it too") {
  const World world = HillSide().world(
      fmt::format("{}[[track]]\nid = \"a\"\nwaypoints_wgs84 = [[0, 48.137, 11.575, 0], [10, 48.137, 11.576, 0]]\n"
                  "[[mount]]\nname = \"roof\"\noffset_m = [0, 0, 1.6]\nrole = \"transmitter\"\n"
                  "[[mount]]\nname = \"above\"\noffset_m = [1, 0, 1.6]\nabove = \"ground\"\n"
                  "role = \"transmitter\"\n[time]\nstep_s = 5\n",
                  receiver));
  REQUIRE(world.clock.frame_count() == 3);
  REQUIRE(world.transmitters.ends.size() == 2);
  const glm::dvec3 roof = world.state(2).transmitters[0].position_m, above = world.state(2).transmitters[1].position_m,
                   first = world.state(0).transmitters[0].position_m;
  const double along = std::atan(slope);
  CHECK(roof.x - first.x == doctest::Approx(74.389636).epsilon(1e-5));
  CHECK(roof.z - first.z == doctest::Approx(slope * (74.389636)).epsilon(1e-4));
  // The roof leans back on the slope; the other stands straight up above the ground.
  CHECK(above.x - roof.x == doctest::Approx(std::cos(along) + 1.6 * std::sin(along)).epsilon(1e-3));
  CHECK(above.z - roof.z == doctest::Approx(1.6 - 1.6 * std::cos(along) + std::sin(along)).epsilon(1e-2));
}

TEST_CASE("trajectories in degrees, and metres above the ground") {
  const TemporaryFolder folder;
  const auto file = folder.write("drive.csv", "time,id,lat,lon\n0,a,48.137,11.575\n1,a,48.137,11.5752\n");
  const World world = HillSide().world(
      fmt::format("{}[trajectories]\nfile = \"{}\"\n[[mount]]\nname = \"roof\"\nrole = \"transmitter\"\n", receiver,
                  file.string()));
  const Track& track = world.fleet.trajectories.tracks.at(0);
  CHECK(track.samples[1].position_m.z - track.samples[0].position_m.z ==
        doctest::Approx(slope * (track.samples[1].position_m.x - track.samples[0].position_m.x)));
  const auto metres = folder.write("metres.csv", "time,id,x,y\n0,a,0,0\n1,a,10,0\n");
  const World flat = HillSide().world(fmt::format(
      "{}[trajectories]\nfile = \"{}\"\nabove = \"ground\"\n[[mount]]\nname = \"roof\"\nrole = \"transmitter\"\n",
      receiver, metres.string()));
  CHECK(flat.transmitters.ends[0].position_m[2] == doctest::Approx(500));
}

// By the series of Krueger to the sixth order, 48.138 north and 11.576 east is 70.665866 m east and 113.628350 m north.
TEST_CASE("grids between corners in degrees, or one corner in degrees and the other in metres") {
  const World world = HillSide().world(
      "[[transmitter]]\nname = \"tx\"\nposition_m = [0, 0, 600]\n"
      "[[receiver_grid]]\nname = \"g\"\nsouth_west_wgs84 = [48.137, 11.575]\nnorth_east_wgs84 = [48.138, 11.576]\n"
      "step_m = 50\nheight_m = 2\nabove = \"ground\"\n"
      "[[receiver_grid]]\nname = \"h\"\nx_min_m = -9.334134\ny_min_m = -6.371650\nnorth_east_wgs84 = [48.138, 11.576]\n"
      "step_m = 40\nheight_m = 700\n");
  const std::vector<RadioEnd>& rx = world.receivers.ends;
  REQUIRE(rx.size() == 2 + 2 * 3);
  check_place(rx[0].position_m, {35.332933, 31.814175, 500 + slope * 35.332933 + 2});
  check_place(rx[1].position_m, {35.332933, 81.814175, 500 + slope * 35.332933 + 2});
  CHECK(rx[7].name == "h/1,2");
  check_place(rx[7].position_m, {50.665866, 93.628350, 700});
}

TEST_CASE("what is said of the cells of a grid knows where its corners in degrees are") {
  const HillSide hill;
  const Config config = hill.config(
      "[[transmitter]]\nname = \"tx\"\nposition_m = [0, 0, 600]\n"
      "[[receiver_grid]]\nname = \"house\"\nsouth_west_wgs84 = [48.138, 11.576]\nx_max_m = 159.3\ny_max_m = 114\n"
      "step_m = 80\nheight_m = 512\n");
  const Scene scene = load_scene(config);
  const World world = make_world(config, scene);
  const std::vector<std::string> said = place_warnings(config, Surroundings(scene), world);
  REQUIRE(said.size() == 1);
  CHECK(said[0] == "all of 1 receivers of grid \"house\" are inside closed bodies");
}

TEST_CASE("what has no place says which and why") {
  const auto has = [](const std::string& text, const std::string& part) {
    CAPTURE(text);
    CHECK(text.find(part) != text.npos);
  };
  const std::string tx = "[[transmitter]]\nname = \"tx\"\n";
  has(problem(receiver + tx + "position_wgs84 = [48.5, 11.575, 6]\n"),
      "\"tx\": its height is above the ground, but there is no ground at");
  has(problem(receiver + tx + "position_wgs84 = [95, 11.575, 6]\n"),
      "test.toml:8:18: latitude 95 and longitude 11.575 are no place");
  has(problem(receiver + tx),
      "[[transmitter]] has no position_m: give it three numbers from -1000000000 to 1000000000 (m), "
      "or give position_wgs84");
  has(problem(receiver + tx + "position_wgs84 = [48, 11, 6]\nposition_m = [0, 0, 0]\n"),
      "[[transmitter]] has both position_m and position_wgs84");
  Config city = HillSide().config(receiver + tx + "position_wgs84 = [48.137, 11.575, 6]\n");
  city.scene.file.clear();
  city.scene.generate = "--seed 1 --blocks 1";
  CHECK_THROWS_WITH_AS(make_world(city, load_scene(city)), doctest::Contains("needs a georeference.json"), ConfigError);
  const std::string grid = tx + "position_m = [0, 0, 600]\n[[receiver_grid]]\nname = \"g\"\n";
  has(problem(grid + "south_west_wgs84 = [48.138, 11.575]\nnorth_east_wgs84 = [48.137, 11.576]\n"),
      "[[receiver_grid]] \"g\": y_max_m = 2.49202 is below y_min_m = 111.136");
  Config map = HillSide().config(grid + "north_east_wgs84 = [48.138, 11.576]\n");
  map.scene = city.scene;
  CHECK_THROWS_WITH_AS(make_world(map, load_scene(map)),
                       doctest::Contains("[[receiver_grid]] \"g\", north_east_wgs84: a position in degrees needs a "
                                         "georeference.json"),
                       ConfigError);
}

TEST_CASE("a configuration in degrees comes back from its own text") {
  const Config config = HillSide().config(
      "[[station]]\nname = \"s\"\nposition_wgs84 = [48.137, 11.575, 6]\n[[receiver]]\nname = \"r\"\nposition_m = [1, "
      "2, 3]\n"
      "[[track]]\nid = \"a\"\nwaypoints_wgs84 = [[0, 48.137, 11.575, 0], [10, 48.137, 11.576, 0]]\n");
  const Config again = parse_config(config.text, "again.toml", {});
  CHECK(again.stations[0].position_wgs84 == config.stations[0].position_wgs84);
  CHECK(again.tracks[0].waypoints_wgs84 == config.tracks[0].waypoints_wgs84);
  CHECK(again.receivers[0].position_m == config.receivers[0].position_m);
  CHECK(again.text == config.text);
}
