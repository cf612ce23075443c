// SPDX-License-Identifier: Apache-2.0
// World: poses of mounted antennas and placed bodies against closed forms and differences.
#include <set>
#include "simulation/world_fixture.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("without vehicles: one frame at 0 s, every pair, ends where they stand") {
  Config config;
  config.transmitters = {end("a", {100, -50, 2}), end("b", {101, -50, 2})};
  config.receivers = {end("c", {110, -40, 5}), end("d", {0, 0, 0})};
  config.receivers[0].velocity_m_s = {1, 2, 3};
  config.receivers[0].orientation_deg = {90, 0, 0};
  const World world = make_world(config, static_scene());
  CHECK(world.clock.frame_count() == 1);
  CHECK(world.clock.time_s(0) == 0);
  CHECK_THROWS_AS(world.state(1), ConfigError);
  const WorldState state = world.state(0);
  CHECK(state.links == std::vector<Link>{{0, 0}, {0, 1}, {1, 0}, {1, 1}});
  CHECK(state.receivers[0].position_m == glm::dvec3(10, 10, 3));
  CHECK(state.receivers[0].velocity_m_s == glm::dvec3(1, 2, 3));
  check_near(state.receivers[0].rotation * glm::dvec3(1, 0, 0), {0, 1, 0}, 1e-15);
  CHECK(state.receivers[0].instance == no_instance);
  CHECK(world.reach_m == 100);
  CHECK(world.fleet.instances.empty());
}

TEST_CASE("antennas on a turning vehicle: closed forms at the samples") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.mounts[0].orientation_deg = {90, 0, 0};
  config.trajectories.offset_m = {1000, 2000, -3};
  const Scene scene = static_scene();
  const World world = make_world(config, scene);
  REQUIRE(world.clock.frame_count() == 21);
  REQUIRE(world.transmitters.ends.size() == 3);
  CHECK(world.transmitters.ends[1].name == "turner/roof");
  CHECK(world.receivers.ends[1].name == "truck1/roof");
  const glm::dvec3 shift = glm::dvec3(1000, 2000, -3) - scene.origin_m;
  for (uint32_t frame = 1; frame < 20; ++frame) {
    CAPTURE(frame);
    const double time_s = 0.1 * frame, c = std::cos(turner_yaw(time_s)), s = std::sin(turner_yaw(time_s));
    CHECK(world.clock.time_s(frame) == doctest::Approx(time_s).epsilon(1e-12));
    const WorldState state = world.state(frame);
    const EndState& roof = state.transmitters[1];
    const glm::dvec3 arm(-0.5 * c - 0.25 * s, -0.5 * s + 0.25 * c, 1.6);
    check_near(roof.position_m, turner_centre(time_s) + arm + shift, 1e-9);
    check_near(roof.velocity_m_s, glm::dvec3(speed_m_s * c - rate_rad_s * arm.y, speed_m_s * s + rate_rad_s * arm.x, 0),
               1e-9);
    check_near(roof.rotation * glm::dvec3(1, 0, 0), {-s, c, 0}, 1e-12);  // turned left by 90 degrees
    check_near(roof.rotation * glm::dvec3(0, 0, 1), {0, 0, 1}, 1e-12);
    CHECK(roof.instance == 0);
    CHECK(state.receivers[0].position_m == roof.position_m);  // one antenna in both roles
  }
}

TEST_CASE("velocities are the derivatives of positions, between samples too") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.time = {.start_s = 0.52, .end_s = 0.58, .step_s = 1e-4};
  const World world = make_world(config, static_scene());
  for (uint32_t frame = 1; frame + 1 < world.clock.frame_count(); frame += 37) {
    const WorldState before = world.state(frame - 1), at = world.state(frame), after = world.state(frame + 1);
    const double time_s = after.time_s - before.time_s;
    for (size_t i = 0; i < at.transmitters.size(); ++i)
      check_near((after.transmitters[i].position_m - before.transmitters[i].position_m) / time_s,
                 at.transmitters[i].velocity_m_s, 1e-6);
    REQUIRE(at.instances.size() == 2);
    for (size_t i = 0; i < at.instances.size(); ++i) {
      const Placement &a = before.instances[i], &p = at.instances[i], &b = after.instances[i];
      for (const glm::dvec3& point : {glm::dvec3(0), glm::dvec3(2, -1, 0.5)})
        check_near((b.position_m + b.rotation * point - a.position_m - a.rotation * point) / time_s,
                   p.velocity_m_s + glm::cross(p.angular_velocity_rad_s, p.rotation * point), 1e-6);
    }
  }
}

TEST_CASE("a vehicle that climbs: pitch is nose up, and the antenna leans back with it") {
  Config config;
  config.transmitters = {end("rsu", {0, 0, 6})};
  config.tracks = {{"ego", "passenger", {{0, 100, -50, 2}, {5, 115, -50, 22}, {10, 130, -50, 42}}}};
  config.mounts = {mount("roof", "ego", "receiver", {0, 0, 1})};
  config.time.step_s = 2.5;
  const World world = make_world(config, static_scene());
  REQUIRE(world.clock.frame_count() == 5);
  const EndState roof = world.state(2).receivers[0];
  check_near(roof.position_m, {15 - 0.8, 0, 20 + 0.6}, 1e-12);
  check_near(roof.rotation * glm::dvec3(1, 0, 0), {0.6, 0, 0.8}, 1e-12);
  check_near(roof.velocity_m_s, {3, 0, 4}, 1e-12);
}

TEST_CASE("absent vehicles stay where they were last, finite, and have no links") {
  const TemporaryFolder folder;
  const World world = make_world(drive(folder), static_scene());
  const glm::dvec3 roof(-0.5, 0.25, 1.6), origin = static_scene().origin_m;
  const auto truck = [&](uint32_t frame) { return world.state(frame).receivers[1]; };
  CHECK_FALSE(truck(4).present);
  CHECK(truck(5).present);
  CHECK(truck(15).present);
  CHECK_FALSE(truck(16).present);
  check_near(truck(0).position_m, truck_centre(0.5) + roof - origin, 1e-9);
  check_near(truck(20).position_m, truck_centre(1.5) + roof - origin, 1e-9);
  CHECK_FALSE(world.state(20).instances[1].present);
  CHECK(world.state(20).instances[0].present);
  // rsu, turner/roof, truck1/roof to turner/roof, truck1/roof
  CHECK(world.state(4).links == std::vector<Link>{{0, 0}});
  CHECK(world.state(10).links == std::vector<Link>{{0, 0}, {0, 1}, {1, 1}, {2, 0}});
}

TEST_CASE("frames of [time] are the same whatever times count from, up to the last one, and messages tell them apart") {
  const TemporaryFolder folder;
  for (const double zero_s : {0.0, 1.7e9, 1e12}) {
    CAPTURE(zero_s);
    Config config = drive(folder);
    config.trajectories.file.clear();
    config.tracks = {{"a", "passenger", {{zero_s, 0, 0, 0}, {zero_s + 0.05, 0.7, 0, 0}}}};
    config.time = {.start_s = zero_s, .end_s = zero_s + 0.05, .step_s = 0.01};
    const World world = make_world(config, static_scene());
    REQUIRE(world.clock.frame_count() == 6);
    for (const std::string& warning : world.warnings) CHECK(warning.find("have no vehicle") == warning.npos);
    for (uint64_t frame = 0; frame < 6; ++frame) CHECK(world.state(frame).instances.at(0).present);
    config.time.start_s = zero_s + 2;
    config.time.end_s = zero_s + 3;
    check_contains(
        error_of<ConfigError>(config),
        fmt::format("goes from {0} to {1} s, and the trajectories go from {2} to {2}", zero_s + 2, zero_s + 3, zero_s));
  }
}

TEST_CASE("bodies: one model a kind and size, placed on the vehicle, surfaces numbered on") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.tracks = {{"second", "passenger", {{0, 0, 90, 0}, {2, 20, 90, 0}}}};
  const Scene scene = static_scene();
  const World world = make_world(config, scene);
  REQUIRE(world.fleet.instances.size() == 3);
  REQUIRE(world.fleet.models.size() == 2);
  const auto& instances = world.fleet.instances;
  CHECK(instances[0].id == "second");  // by time, then by id
  CHECK(instances[1].id == "turner");
  CHECK(instances[2].type == "truck");
  CHECK(instances[0].model == instances[1].model);
  uint32_t surface = 7;
  for (const Instance& instance : instances) {
    CHECK(instance.first_surface == surface);
    surface += static_cast<uint32_t>(world.fleet.models[instance.model].surfaces.size());
  }
  const WorldState state = world.state(10);
  const Extent car = extent_of(world.fleet.models[instances[1].model], state.instances[1],
                               turner_centre(1) - scene.origin_m, turner_yaw(1));
  check_near(car.upper, {2.3, 0.9, 1.5}, 1e-9);
  CHECK(car.lower.x == doctest::Approx(-2.3));
  CHECK(car.lower.y == doctest::Approx(-0.9));
  const Extent truck =
      extent_of(world.fleet.models[instances[2].model], state.instances[2], truck_centre(1) - scene.origin_m, 0);
  check_near(truck.upper, {3.55, 1.2, 2.4}, 1e-9);
}

TEST_CASE("bodies by the name of the type; none where none is wanted, with antennas all the same") {
  const TemporaryFolder folder;
  const auto models = [&](const std::string& type, const std::string& model = "auto") {
    Config config = drive(folder, two_vehicles(type));
    config.vehicle_types.push_back({.name = type, .model = model, .length_m = 7.1, .width_m = 2.4, .height_m = 2.4});
    const World world = make_world(config, static_scene());
    CHECK(world.transmitters.ends.size() == 3);
    CHECK(world.state(10).transmitters[2].instance == (world.fleet.instances.size() == 2 ? 1 : no_instance));
    return world.fleet.models;
  };
  const auto surfaces = [&](const std::string& model) { return models("x", model).back().surfaces.size(); };
  const size_t car = surfaces("car"), van = surfaces("van"), truck = surfaces("truck"), bus = surfaces("bus"),
               cycle = surfaces("motorcycle"), person = surfaces("pedestrian");
  CHECK(std::set<size_t>{car, van, truck, bus, cycle, person}.size() == 6);
  for (const std::string type : {"bicycle", "motorcycle", "my_moped2"})
    CHECK(models(type).back().surfaces.size() == cycle);
  for (const std::string type : {"pedestrian", "DEFAULT_PEDTYPE"}) CHECK(models(type).back().surfaces.size() == person);
  for (const std::string type : {"truck2", "veh_trailer"}) CHECK(models(type).back().surfaces.size() == truck);
  for (const std::string type : {"bus", "COACH"}) CHECK(models(type).back().surfaces.size() == bus);
  for (const std::string type : {"delivery", "emergency1"}) CHECK(models(type).back().surfaces.size() == van);
  for (const std::string type : {"taxi", "mine", "passenger/truck"}) CHECK(models(type).back().surfaces.size() == car);
  CHECK(models("mine", "none").size() == 1);
}

TEST_CASE("a mesh as body: in its own size, or stretched to the sizes that are given, planes included") {
  const TemporaryFolder folder;
  const std::string wedge =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "-1 -0.5 0.25\n3 -0.5 0.25\n-1 0.5 0.25\n-1 -0.5 2.25\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  Config config = drive(folder);
  config.vehicle_types.push_back({.name = "truck", .model = folder.write("wedge.ply", wedge).string()});
  const glm::dvec3 centre = truck_centre(1) - static_scene().origin_m;
  {
    // FCD positions are those of the front bumper, 7.1 m / 2 ahead of where the truck is; the mesh is 4 m long.
    const World world = make_world(config, static_scene());
    const Extent own = extent_of(world.fleet.models.back(), world.state(10).instances[1], centre, 0);
    check_near(own.lower, {-1 + 3.55 - 2, -0.5, 0.25}, 1e-9);
    check_near(own.upper, {3 + 3.55 - 2, 0.5, 2.25}, 1e-9);
  }
  config.vehicle_types.back().length_m = 7.1;
  config.vehicle_types.back().height_m = 5;
  const World world = make_world(config, static_scene());
  const Scene& model = world.fleet.models.back();
  const Extent stretched = extent_of(model, world.state(10).instances[1], centre, 0);
  check_near(stretched.lower, {-1 * 7.1 / 4, -0.5, 0.25 * 2.5}, 1e-9);
  check_near(stretched.upper, {3 * 7.1 / 4, 0.5, 2.25 * 2.5}, 1e-9);
  REQUIRE(model.surfaces.size() == 4);
  for (size_t t = 0; t < model.triangles.size(); ++t) {
    const Surface& surface = model.surfaces[model.triangle_surface[t]];
    CHECK(glm::length(surface.normal) == doctest::Approx(1).epsilon(1e-14));
    for (const uint32_t vertex : model.triangles[t])
      CHECK(std::abs(glm::dot(surface.normal, model.vertices[vertex]) - surface.offset_m) < 1e-12);
  }
}
