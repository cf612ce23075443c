// SPDX-License-Identifier: Apache-2.0
// Tests bodies from files: materials and nodes of a GLB that trimesh wrote (files/make_car.py), nodes of built-in
// bodies, antennas at them, and parked vehicles.
#include <map>

#include "folders.hpp"
#include "simulation/world_fixture.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const std::string car_glb = test::source_folder() + "/tests/simulation/files/car.glb";

// A vehicle that begins at (10, 20, 0) and looks along +y.
Config ego(const std::string& type = "passenger") {
  Config config;
  config.tracks = {{"ego", type, {{0, 10, 20, 0}, {2, 10, 40, 0}}}};
  config.time.step_s = 1;
  config.transmitters = {end("rsu", {0, 0, 6})};
  config.mounts = {mount("roof", "ego", "both", {0, 0, 0})};
  config.scene.material_alias = {{"CarPaint", "metal"}};
  config.materials = {{.name = "Tyre", .permittivity = 5, .conductivity_s_m = 0.1}};
  return config;
}

glm::dvec3 roof_of(const Config& config) {
  const Scene scene = static_scene();
  return make_world(config, scene).state(0).receivers.at(0).position_m + scene.origin_m;
}

}  // namespace

TEST_CASE("a GLB of four materials keeps them apart, and what names are in it is told where one is unknown") {
  Config config = ego();
  config.vehicle_types = {{.name = "passenger", .model = car_glb}};
  const World world = make_world(config, static_scene());
  const Scene& car = world.fleet.models.at(0);
  std::map<std::string, size_t> surfaces;
  for (const Surface& surface : car.surfaces) ++surfaces[car.materials[surface.material].name];
  CHECK(surfaces == std::map<std::string, size_t>{{"metal", 6}, {"vehicle_glass", 6}, {"plastic", 6}, {"Tyre", 24}});
  config.materials.clear();
  check_contains(error_of<InputError>(config), "the material 'Tyre' is not known");
}

TEST_CASE("an antenna at a node of the mesh, which goes with the body where that is stretched") {
  Config config = ego();
  config.vehicle_types = {{.name = "passenger", .model = car_glb}};
  config.mounts[0].node = "roof_antenna";  // 0.75 m behind the middle, 0.125 m to the left, 1.5625 m up
  check_near(roof_of(config), {10 - 0.125, 20 - 0.75, 1.5625}, 1e-6);
  config.mounts[0].offset_m = {1, 0.5, 0.25};
  check_near(roof_of(config), {10 - 0.125 - 0.5, 20 - 0.75 + 1, 1.8125}, 1e-6);
  config.mounts[0].offset_m = {0, 0, 0};
  config.vehicle_types[0].length_m = 8.8;  // twice 4.4
  config.vehicle_types[0].width_m = 3.6;   // twice 1.8
  check_near(roof_of(config), {10 - 0.25, 20 - 1.5, 1.5625}, 1e-6);
}

TEST_CASE("an antenna at a node of a built-in body") {
  Config config = ego("truck");
  config.materials.clear();
  config.mounts[0].node = "front_antenna";
  check_near(roof_of(config), {10, 20 + 7.1 / 2 + 0.05, 0.35 * 2.4}, 1e-9);
  config.mounts[0].node = "roof_antenna";
  check_near(roof_of(config), {10, 20 + (-0.5 + 0.2) / 2 * 7.1, 2.45}, 1e-9);
}

TEST_CASE("a node that the body does not have is an error with the nearest name") {
  Config config = ego();
  config.vehicle_types = {{.name = "passenger", .model = car_glb}};
  config.mounts[0].node = "roof_antena";
  const std::string text = error_of<ConfigError>(config);
  check_contains(text,
                 "[[mount]] \"roof\": node = \"roof_antena\": the vehicle \"ego\" of type \"passenger\" has no such");
  check_contains(text, "car.glb");
  check_contains(text, "\"roof_antenna\"");
  config.vehicle_types = {{.name = "passenger", .model = "none"}};
  check_contains(error_of<ConfigError>(config), "has no body, and so no nodes");
}

TEST_CASE("persons and two-wheelers have bodies, of skin and metal") {
  for (const auto& [type, material] : {std::pair{"pedestrian", "human_skin"},
                                       {"DEFAULT_PEDTYPE", "human_skin"},
                                       {"motorcycle", "metal"},
                                       {"bicycle", "metal"},
                                       {"tram", "metal"}}) {
    CAPTURE(type);
    Config config = ego(type);
    config.mounts[0].node = "roof_antenna";
    const World world = make_world(config, static_scene());
    CHECK(world.fleet.models.at(0).materials.at(0).name == material);
  }
}

TEST_CASE("parked vehicles stand in all frames, carry nothing, and say nothing of the times") {
  const TemporaryFolder folder;
  Config config = ego();
  config.mounts[0].on = "*";
  config.parked.resize(2);
  config.parked[0].name = "kerb";
  config.parked[0].places = {{-20, 4, 0, 180}, {-26, 4, 0.5, 90}};
  config.parked[1].name = "lot";
  config.parked[1].file = folder.write("lot.csv", "x,y,yaw,type\n1,2,-90,truck\n3,4,,\n").string();
  config.time.end_s = 3;  // a second after the drive
  const Scene scene = static_scene();
  const World world = make_world(config, scene);
  CHECK(world.clock.frame_count() == 4);
  REQUIRE(world.fleet.instances.size() == 5);
  CHECK(world.receivers.ends.size() == 1);
  std::map<std::string, size_t> at;
  for (size_t i = 0; i < 5; ++i) at[world.fleet.instances[i].id] = i;
  CHECK(world.fleet.instances[at.at("lot/0")].type == "truck");
  CHECK(world.fleet.instances[at.at("lot/1")].type == "passenger");
  for (uint32_t frame = 0; frame < 4; ++frame) {
    CAPTURE(frame);
    const WorldState state = world.state(frame);
    CHECK(state.instances[at.at("ego")].present == (frame < 3));
    for (const char* id : {"kerb/0", "kerb/1", "lot/0", "lot/1"}) CHECK(state.instances[at.at(id)].present);
    const Extent truck = extent_of(world.fleet.models[world.fleet.instances[at.at("lot/0")].model],
                                   state.instances[at.at("lot/0")], glm::dvec3(1, 2, 0) - scene.origin_m, -pi / 2);
    check_near(truck.upper, {3.55, 1.2, 2.4}, 1e-9);
    CHECK(state.instances[at.at("kerb/1")].velocity_m_s == glm::dvec3(0));
  }
  config.parked[0].mounts = true;
  CHECK(make_world(config, scene).receivers.ends.size() == 3);
  config.tracks.clear();
  config.time = {};
  CHECK(make_world(config, scene).clock.frame_count() == 1);
}

TEST_CASE("a parked vehicle of no known type, or of a name that is taken, is an error") {
  Config config = ego();
  config.parked.resize(1);
  config.parked[0].name = "kerb";
  config.parked[0].places = {{0, 0, 0, 0}};
  config.parked[0].type = "spaceship9";
  check_contains(error_of<ConfigError>(config), "[[parked]] \"kerb\", place 0: the type \"spaceship9\" is neither");
  config.parked[0].type = "passenger";
  config.tracks[0].id = "kerb/0";
  config.mounts[0].on = "*";
  check_contains(error_of<ConfigError>(config), "the trajectories have a vehicle \"kerb/0\" too");
}

TEST_CASE("what is left out of the file of a vehicle is told, once for all that have it; so is one of kilometres") {
  const TemporaryFolder folder;
  const std::string box =
      "v 0 0 0\nv 4 0 0\nv 4 2 0\nv 0 2 0\nv 0 0 1\nv 4 0 1\nv 4 2 1\nv 0 2 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\n"
      "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nl 1 2\n";
  Config config = ego();
  config.materials.clear();
  config.vehicle_types = {{.name = "passenger", .model = folder.write("car.obj", box).string()}};
  const auto count = [&](const char* text) {
    const World world = make_world(config, static_scene());
    return std::ranges::count_if(world.warnings, [&](const std::string& w) { return w.find(text) != w.npos; });
  };
  CHECK(count("car.obj:15: 1 lines and points were left out") == 1);
  CHECK(count("is it in metres?") == 0);
  std::string large = box;
  for (size_t at = large.find("v 4"); at != large.npos; at = large.find("v 4", at + 1)) large.replace(at, 3, "v 4000");
  config.vehicle_types[0].model = folder.write("large.obj", large).string();
  CHECK(count("the model of a vehicle is 4000 m long: is it in metres?") == 1);
}
