// SPDX-License-Identifier: Apache-2.0
// Tests warnings about ends and vehicles at impossible places: each is named, many are counted, and there is none where
// everything is right. The scene is a house of 12 triangles on a ground of 200 m, and rooms.
#include "simulation/place_warnings.hpp"

#include "scene/load.hpp"
#include "simulation/place_cases.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;

namespace {

std::vector<Quad> house() { return reference::box_walls({10, 20, 0}, {30, 28, 9}); }
const std::vector<Part> town{{{ground}}, {house()}};

Texts warnings_of(const std::vector<Part>& parts, const Config& config) {
  const SceneFile file(parts);
  const Scene scene = load_scene_file(file.path(), {});
  return Texts(place_warnings(config, Surroundings(scene), make_world(config, scene)));
}

Config ends(const Points& transmitters, const Points& receivers) {
  return config_of("", transmitters, receivers, 1, 1);
}

MountConfig roof(double height_m) {
  MountConfig out;
  out.name = "roof";
  out.offset_m = {0, 0, height_m};
  return out;
}

Config drive(const std::vector<std::array<double, 4>>& waypoints) {
  Config config = ends({{0, 0, 6}}, {});
  config.tracks = {{"ego", "passenger", waypoints}};
  config.mounts = {roof(1.6)};
  config.time.step_s = 0.1;
  return config;
}

}  // namespace

TEST_CASE("nothing to say of ends over the ground, on roofs, at one place, or all in one room") {
  CHECK(warnings_of(town, ends({{0, 0, 6}, {20, 24, 12}}, {{50, 50, 1.5}, {-20, 30, 0.5}})).empty());
  CHECK(warnings_of(town, ends({{0, 0, 6}}, {{0, 0, 6}, {40, 0, 2}})).empty());
  CHECK(warnings_of({{reference::box_walls({0, 0, 0}, {10, 8, 3})}}, ends({{1, 2, 1}}, {{8, 7, 2}})).empty());
  CHECK(warnings_of({{house()}}, ends({{15, 22, 2}}, {{28, 26, 3}})).empty());
}

TEST_CASE("each kind by name") {
  const Config config = ends({{15, 22, 2}, {0, 0, -1.5}, {3100, 0, 2}}, {{-40, 0, 0}, {50, 50, 300}, {-60, 10, 2}});
  CHECK(warnings_of(town, config) == Texts{"transmitter \"tx0\" is inside a closed body, \"part-1\"",
                                           "transmitter \"tx1\" is 1.5 m below the ground there, \"part-0\"; "
                                           "above = \"ground\" lets its height count from the ground",
                                           "transmitter \"tx2\" is 3000 m outside of the scene's box",
                                           "receiver \"rx1\" is 291 m above the scene's box",
                                           "receiver \"rx0\" lies on a surface of \"part-0\"; because of rounding, "
                                           "the surface may hide it: move it away by 1 mm"});
}

TEST_CASE("in a house that is the scene: a word only where a link goes out of it") {
  const Texts out = warnings_of({{house()}}, ends({{15, 22, 2}}, {{28, 26, 3}, {30.5, 24, 3}}));
  CHECK(out == Texts{"transmitter \"tx0\" is inside a closed body, \"part-0\""});
}

TEST_CASE("within a wavelength of another end; an end and its twin are one") {
  Config config = ends({{0, 0, 6}}, {{0.02, 0, 6}, {0, 0, 6}});
  const Texts out = warnings_of(town, config);
  REQUIRE(out.size() == 1);
  CHECK(out[0].find("receiver \"rx0\" is 0.02 m from transmitter \"tx0\", less than a wavelength (0.0508 m)") == 0);
  config.links.receivers = {"rx1"};
  CHECK(warnings_of(town, config).empty());
}

TEST_CASE("many ends: five by name, then their number; an end that sends and receives is named once") {
  Points inside;
  for (int i = 0; i < 12; ++i) inside.push_back({11.0 + i, 24, 2});
  Points outside{{0, 0, 6}};
  const Texts out = warnings_of(town, ends(inside, outside));
  REQUIRE(out.size() == 6);
  CHECK(out[4].find("transmitter \"tx4\" is inside") == 0);
  CHECK(out[5] == "7 other antennas are inside closed bodies");
  const Texts twins = warnings_of(town, ends({inside[0], outside[0]}, {inside[0]}));
  CHECK(twins == Texts{"transmitter \"tx0\" is inside a closed body, \"part-1\""});
}

TEST_CASE("receivers of grids are counted: by cells in the house, and whole grids in it") {
  Config config = ends({{0, 0, 6}}, {});
  config.receiver_grids = {{.name = "g", .x_min_m = 0, .x_max_m = 40, .y_min_m = 10, .y_max_m = 40, .step_m = 1}};
  CHECK(warnings_of(town, config) == Texts{"160 of 1200 receivers of grid \"g\" are inside closed bodies"});
  config.receiver_grids[0].height_m = -0.5;
  CHECK(warnings_of(town, config) == Texts{"all of 1200 receivers of grid \"g\" are below the ground; "
                                           "above = \"ground\" lets height_m count from the ground"});
  config.receiver_grids[0].above = "ground";
  CHECK(warnings_of(town, config) ==
        Texts{"all of 1200 receivers of grid \"g\" are below the ground; give it a height_m above 0"});
  config.receiver_grids = {{.name = "rooms", .x_min_m = 11, .x_max_m = 29, .y_min_m = 21, .y_max_m = 27, .step_m = 1}};
  CHECK(warnings_of(town, config) == Texts{"all of 108 receivers of grid \"rooms\" are inside closed bodies"});
  ReceiverGridConfig cut;
  cut.name = "cut";
  cut.from_m = {11, 24};
  cut.to_m = {29, 24};
  cut.z_min_m = 1;
  cut.z_max_m = 3;
  cut.step_m = 1;
  config.receiver_grids = {cut};
  CHECK(warnings_of(town, config) == Texts{"all of 36 receivers of grid \"cut\" are inside closed bodies"});
}

TEST_CASE("vehicles: through a house from when on, below and above the ground; none on it, and none in a garage") {
  CHECK(warnings_of(town, drive({{0, -50, -3, 0}, {4, 50, -3, 0}})).empty());
  CHECK(warnings_of({{reference::box_walls({0, 0, 0}, {60, 20, 6})}},
                    [] {
                      Config garage = drive({{0, 10, 10, 0}, {4, 50, 10, 0}});
                      garage.transmitters = {{.name = "t", .position_m = {5, 5, 3}}};
                      return garage;
                    }())
            .empty());
  // 10 m/s: in the house from 1 s on, and out of it at 3 s.
  const Texts through =
      warnings_of(town, drive({{0, 0.05, 24, 0}, {1, 10.05, 24, 0}, {2, 20.05, 24, 0}, {6, 60.05, 24, 0}}));
  REQUIRE(through.size() == 1);
  CHECK(through[0].find(
            "1 of 1 vehicles drive through closed bodies, the first one \"ego\" through \"part-1\" from 1 s on") == 0);
  CHECK(warnings_of(town, drive({{0, -50, -3, -2}, {4, 50, -3, -2}}))[0].find(
            "1 of 1 vehicles are below the ground, the first one \"ego\" by 2 m from 0 s on") == 0);
  CHECK(warnings_of(town, drive({{0, -50, -3, -0.7}, {4, 50, -3, -0.7}}))[0].find("\"ego\" by 0.7 m from 0 s on") !=
        std::string::npos);
  CHECK(warnings_of(town, drive({{0, -50, -3, 0}, {4, 50, -3, 4}}))[0].find(
            "vehicles are above the ground, the first one") != std::string::npos);
  // The ground ends at 100 m.
  const Texts off = warnings_of(town, drive({{0, 60, -3, 0}, {4, 100.5, -3, 0}, {8, 140, -3, 0}}));
  REQUIRE(off.size() == 1);
  CHECK(off[0].find("1 of 1 vehicles drive off the ground, the first one \"ego\" at (100, -3) m from 4 s on: "
                    "nothing reflects there") == 0);
  CHECK(warnings_of({{house()}, {reference::box_walls({-90, -90, 0}, {-80, -80, 9})}},
                    drive({{0, 50, -3, 0}, {4, 90, -3, 0}}))
            .empty());  // no ground at all
  Config low = drive({{0, -50, -3, 0}, {4, 50, -3, 0}});
  low.mounts = {roof(-0.3)};
  CHECK(warnings_of(town, low) == Texts{"[[mount]] \"roof\": offset_m is 0.3 m below the ground under its vehicle"});
}

TEST_CASE("a drive of a million frames is looked at in as many places as a short one") {
  Config config = drive({{0, -90, 24, 0}, {1e5, 90, 24, 0}});
  const Texts out = warnings_of(town, config);
  REQUIRE(out.size() == 1);
  CHECK(out[0].find("drive through closed bodies") != std::string::npos);
}

TEST_CASE("links that [links] forbids, and ends that are too far from each other") {
  Config config = ends({{0, 0, 6}}, {{50, 50, 1.5}});
  config.links.i2i = false;
  CHECK(warnings_of(town, config)[0].find("no link is computed: [links] allows none between the 1 transmitters") == 0);
  config.links = {.max_distance_m = 10};
  CHECK(warnings_of(town, config)[0].find("within links.max_distance_m = 10 m of each other") != std::string::npos);
}
