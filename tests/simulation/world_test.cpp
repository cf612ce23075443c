// World: poses of mounted antennas and placed bodies against closed forms and differences, links against counted pairs.
// Vehicles come from FCD files that the tests write: their centres move on circles and lines known exactly.
#include "simulation/world.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <set>

#include "motion/pose.hpp"
#include "scene/scene_files.hpp"
#include "simulation/name_pattern.hpp"
#include "simulation/world_trajectories.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double pi = std::numbers::pi;

Scene static_scene() {
  Scene scene;
  scene.origin_m = {100, -50, 2};
  scene.surfaces.resize(7);
  return scene;
}

void check_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  CAPTURE(a.x);
  CAPTURE(a.y);
  CAPTURE(a.z);
  CAPTURE(b.x);
  CAPTURE(b.y);
  CAPTURE(b.z);
  CHECK(glm::distance(a, b) <= tolerance);
}

template <class E>
std::string error_of(const Config& config) {
  try {
    const World world(config, static_scene());
  } catch (const E& e) {
    return e.what();
  }
  return "no error";
}

void check_contains(const std::string& text, const std::string& part) {
  CAPTURE(text);
  CHECK(text.find(part) != text.npos);
}

// "turner" (passenger, 4.6 m long) drives a circle of 20 m at 10 m/s, counter-clockwise; "truck1" (truck, 7.1 m) along
// +x at 15 m/s, and is there from 0.5 s to 1.5 s only. Both are at 2 m height; 0.1 s between samples.
constexpr double radius_m = 20, speed_m_s = 10, rate_rad_s = speed_m_s / radius_m;

double turner_yaw(double time_s) { return pi / 2 + rate_rad_s * time_s; }
glm::dvec3 turner_centre(double time_s) {
  return {radius_m * std::cos(rate_rad_s * time_s), radius_m * std::sin(rate_rad_s * time_s), 2};
}
glm::dvec3 truck_centre(double time_s) { return {15 * time_s, 30, 2}; }

std::string vehicle(const std::string& id, const std::string& type, const glm::dvec3& centre, double yaw_rad,
                    double speed, double length_m) {
  return fmt::format("<vehicle id=\"{}\" type=\"{}\" x=\"{:.17g}\" y=\"{:.17g}\" z=\"{:.17g}\" angle=\"{:.17g}\" "
                     "speed=\"{}\" slope=\"0\"/>",
                     id, type, centre.x + length_m / 2 * std::cos(yaw_rad), centre.y + length_m / 2 * std::sin(yaw_rad),
                     centre.z, 90 - yaw_rad * 180 / pi, speed);
}

std::string two_vehicles(const std::string& truck_type = "truck") {
  std::string out = "<fcd-export>\n";
  for (int k = 0; k <= 20; ++k) {
    const double time_s = 0.1 * k;
    out += fmt::format("<timestep time=\"{:.1f}\">", time_s);
    out += vehicle("turner", "passenger", turner_centre(time_s), turner_yaw(time_s), speed_m_s, 4.6);
    if (k >= 5 && k <= 15) out += vehicle("truck1", truck_type, truck_centre(time_s), 0, 15, 7.1);
    out += "</timestep>\n";
  }
  return out + "</fcd-export>\n";
}

MountConfig mount(const std::string& name, const std::string& on, const std::string& role,
                  std::array<double, 3> offset_m) {
  MountConfig out;
  out.name = name;
  out.on = on;
  out.role = role;
  out.offset_m = offset_m;
  return out;
}

RadioEnd end(const std::string& name, std::array<double, 3> position_m) {
  RadioEnd out;
  out.name = name;
  out.position_m = position_m;
  return out;
}

Config drive(const TemporaryFolder& folder, const std::string& fcd = two_vehicles()) {
  Config config;
  config.trajectories.file = folder.write("drive.fcd.xml", fcd).string();
  config.vehicle_types.push_back({.name = "passenger", .length_m = 4.6});
  config.transmitters = {end("rsu", {0, 0, 6})};
  config.mounts = {mount("roof", "*", "both", {-0.5, 0.25, 1.6})};
  return config;
}

// The placed model, in the axes of a vehicle that stands at `centre` (scene coordinates) with this yaw.
struct Extent {
  glm::dvec3 lower{1e9}, upper{-1e9};
};
Extent extent_of(const Scene& model, const Placement& placed, const glm::dvec3& centre, double yaw_rad) {
  Extent out;
  for (const glm::dvec3& vertex : model.vertices) {
    const glm::dvec3 p = placed.position_m + placed.rotation * vertex - centre;
    const glm::dvec3 own(std::cos(yaw_rad) * p.x + std::sin(yaw_rad) * p.y,
                         -std::sin(yaw_rad) * p.x + std::cos(yaw_rad) * p.y, p.z);
    out.lower = glm::min(out.lower, own);
    out.upper = glm::max(out.upper, own);
  }
  return out;
}

}  // namespace

TEST_CASE("without vehicles: one frame at 0 s, every pair, ends where they stand") {
  Config config;
  config.transmitters = {end("a", {100, -50, 2}), end("b", {101, -50, 2})};
  config.receivers = {end("c", {110, -40, 5}), end("d", {0, 0, 0})};
  config.receivers[0].velocity_m_s = {1, 2, 3};
  config.receivers[0].orientation_deg = {90, 0, 0};
  const World world(config, static_scene());
  CHECK(world.frame_count() == 1);
  CHECK(world.time_s(0) == 0);
  CHECK_THROWS_AS(world.state(1), ConfigError);
  const WorldState state = world.state(0);
  CHECK(state.links == std::vector<Link>{{0, 0}, {0, 1}, {1, 0}, {1, 1}});
  CHECK(state.receivers[0].position_m == glm::dvec3(10, 10, 3));
  CHECK(state.receivers[0].velocity_m_s == glm::dvec3(1, 2, 3));
  check_near(state.receivers[0].rotation * glm::dvec3(1, 0, 0), {0, 1, 0}, 1e-15);
  CHECK(state.receivers[0].instance == no_instance);
  CHECK(world.reach_m() == 100);
  CHECK(world.instances().empty());
}

TEST_CASE("antennas on a turning vehicle: closed forms at the samples") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.mounts[0].orientation_deg = {90, 0, 0};
  config.trajectories.offset_m = {1000, 2000, -3};
  const Scene scene = static_scene();
  const World world(config, scene);
  REQUIRE(world.frame_count() == 21);
  REQUIRE(world.transmitters().size() == 3);
  CHECK(world.transmitters()[1].name == "turner/roof");
  CHECK(world.receivers()[1].name == "truck1/roof");
  const glm::dvec3 shift = glm::dvec3(1000, 2000, -3) - scene.origin_m;
  for (uint32_t frame = 1; frame < 20; ++frame) {
    CAPTURE(frame);
    const double time_s = 0.1 * frame, c = std::cos(turner_yaw(time_s)), s = std::sin(turner_yaw(time_s));
    CHECK(world.time_s(frame) == doctest::Approx(time_s).epsilon(1e-12));
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
  const World world(config, static_scene());
  for (uint32_t frame = 1; frame + 1 < world.frame_count(); frame += 37) {
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
  const World world(config, static_scene());
  REQUIRE(world.frame_count() == 5);
  const EndState roof = world.state(2).receivers[0];
  check_near(roof.position_m, {15 - 0.8, 0, 20 + 0.6}, 1e-12);
  check_near(roof.rotation * glm::dvec3(1, 0, 0), {0.6, 0, 0.8}, 1e-12);
  check_near(roof.velocity_m_s, {3, 0, 4}, 1e-12);
}

TEST_CASE("absent vehicles stay where they were last, finite, and have no links") {
  const TemporaryFolder folder;
  const World world(drive(folder), static_scene());
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

TEST_CASE("bodies: one model a kind and size, placed on the vehicle, surfaces numbered on") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.tracks = {{"second", "passenger", {{0, 0, 90, 0}, {2, 20, 90, 0}}}};
  const Scene scene = static_scene();
  const World world(config, scene);
  REQUIRE(world.instances().size() == 3);
  REQUIRE(world.models().size() == 2);
  const auto& instances = world.instances();
  CHECK(instances[0].id == "second");  // by time, then by id
  CHECK(instances[1].id == "turner");
  CHECK(instances[2].type == "truck");
  CHECK(instances[0].model == instances[1].model);
  uint32_t surface = 7;
  for (const Instance& instance : instances) {
    CHECK(instance.first_surface == surface);
    surface += static_cast<uint32_t>(world.models()[instance.model].surfaces.size());
  }
  const WorldState state = world.state(10);
  const Extent car = extent_of(world.models()[instances[1].model], state.instances[1],
                               turner_centre(1) - scene.origin_m, turner_yaw(1));
  check_near(car.upper, {2.3, 0.9, 1.5}, 1e-9);
  CHECK(car.lower.x == doctest::Approx(-2.3));
  CHECK(car.lower.y == doctest::Approx(-0.9));
  const Extent truck =
      extent_of(world.models()[instances[2].model], state.instances[2], truck_centre(1) - scene.origin_m, 0);
  check_near(truck.upper, {3.55, 1.2, 2.4}, 1e-9);
}

TEST_CASE("bodies by the name of the type; none where none is wanted, with antennas all the same") {
  const TemporaryFolder folder;
  const auto models = [&](const std::string& type, const std::string& model = "auto") {
    Config config = drive(folder, two_vehicles(type));
    config.vehicle_types.push_back({.name = type, .model = model, .length_m = 7.1, .width_m = 2.4, .height_m = 2.4});
    const World world(config, static_scene());
    CHECK(world.transmitters().size() == 3);
    CHECK(world.state(10).transmitters[2].instance == (world.instances().size() == 2 ? 1 : no_instance));
    return world.models();
  };
  const auto surfaces = [&](const std::string& model) { return models("x", model).back().surfaces.size(); };
  for (const std::string type : {"bicycle", "motorcycle", "pedestrian", "my_moped2", "DEFAULT_PEDTYPE"}) {
    CAPTURE(type);
    CHECK(models(type).size() == 1);
  }
  const size_t car = surfaces("car"), van = surfaces("van"), truck = surfaces("truck");
  CHECK(std::set<size_t>{car, van, truck}.size() == 3);
  for (const std::string type : {"bus", "truck2", "veh_trailer", "COACH"})
    CHECK(models(type).back().surfaces.size() == truck);
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
    const World world(config, static_scene());
    const Extent own = extent_of(world.models().back(), world.state(10).instances[1], centre, 0);
    check_near(own.lower, {-1 + 3.55 - 2, -0.5, 0.25}, 1e-9);
    check_near(own.upper, {3 + 3.55 - 2, 0.5, 2.25}, 1e-9);
  }
  config.vehicle_types.back().length_m = 7.1;
  config.vehicle_types.back().height_m = 5;
  const World world(config, static_scene());
  const Scene& model = world.models().back();
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

TEST_CASE("links by name, kind, vehicle and distance") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.receivers = {end("base", {0, 100, 6})};
  config.mounts.push_back(mount("bumper", "truck*", "receiver", {3.5, 0, 0.5}));
  // tx: rsu, turner/roof, truck1/roof; rx: base, turner/roof, truck1/roof, truck1/bumper
  const auto links = [&](const LinksConfig& rules) {
    config.links = rules;
    return World(config, static_scene()).state(10).links;
  };
  using Links = std::vector<Link>;
  CHECK(links({}) == Links{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 2}, {1, 3}, {2, 0}, {2, 1}});
  CHECK(links({.i2i = false}) == Links{{0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 2}, {1, 3}, {2, 0}, {2, 1}});
  CHECK(links({.v2i = false}) == Links{{0, 0}, {1, 2}, {1, 3}, {2, 1}});
  CHECK(links({.v2v = false}) == Links{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 0}, {2, 0}});
  CHECK(links({.v2v = false, .v2i = false, .i2i = false, .same_vehicle = true}) == Links{{2, 3}});
  CHECK(links({.transmitters = {"rsu"}, .receivers = {"truck1/*", "base"}}) == Links{{0, 0}, {0, 2}, {0, 3}});
  CHECK(links({.transmitters = {"*/roof"}, .receivers = {"?ase"}}) == Links{{1, 0}, {2, 0}});
  // At 1 s: the turner's roof is 20.5 m off the mast (level), the truck's 33.6 m; the mast is 2.4 m higher.
  const glm::dvec3 rsu(0, 0, 6), roof = truck_centre(1) + glm::dvec3(-0.5, 0.25, 1.6);
  const double far_m = glm::distance(rsu, roof);
  LinksConfig near{.max_distance_m = far_m + 1e-6, .transmitters = {"rsu"}, .receivers = {"*roof"}};
  CHECK(links(near) == Links{{0, 1}, {0, 2}});
  near.max_distance_m = far_m - 1e-6;
  CHECK(links(near) == Links{{0, 1}});
}

TEST_CASE("ends that stand in the same place are one end; what stands keeps the link to itself") {
  Config config;
  config.transmitters = {end("a", {5, 0, 6}), end("rsu", {0, 0, 6})};
  config.receivers = {end("rsu_rx", {0, 0, 6}), end("other", {1, 0, 6})};
  const World world(config, static_scene());
  CHECK(world.state(0).links == std::vector<Link>{{0, 0}, {0, 1}, {1, 0}, {1, 1}});
  CHECK(world.receiver_of_transmitter() == std::vector<uint32_t>{no_end, 0});
  CHECK(world.transmitter_of_receiver() == std::vector<uint32_t>{1, no_end});
}

TEST_CASE("types, names and steps that are not known") {
  const TemporaryFolder folder;
  const std::string odd = two_vehicles("spaceship");
  check_contains(error_of<InputError>(drive(folder, odd)), "the vehicle type 'spaceship' is not known");
  Config config = drive(folder, odd);
  config.trajectories.default_type = "truck";
  const World world(config, static_scene());
  CHECK(world.instances()[1].type == "spaceship");
  CHECK(world.models().size() == 2);
  REQUIRE_FALSE(world.warnings().empty());
  config.trajectories.default_type = "passengr";
  check_contains(error_of<ConfigError>(config), "default_type = \"passengr\" is neither a [[vehicle_type]] nor");
  check_contains(error_of<ConfigError>(config), "did you mean \"passenger\"?");
  config = drive(folder);
  config.vehicle_types.push_back({.name = "mine"});
  check_contains(error_of<ConfigError>(config), "vehicle_type \"mine\": SUMO has no vehicle class of this name: give");
  config = drive(folder);
  config.tracks = {{"turner", "passenger", {{0, 0, 0, 0}}}};
  check_contains(error_of<ConfigError>(config), "the trajectories have a vehicle \"turner\" too");
  config.tracks = {{"ego", "hovercraft", {{0, 0, 0, 0}}}};
  check_contains(error_of<ConfigError>(config), "type = \"hovercraft\" is neither a [[vehicle_type]] nor");
  config = drive(folder);
  config.links.receivers = {"*", "truck1/rof"};
  check_contains(error_of<ConfigError>(config),
                 "links.receivers: \"truck1/rof\" is the name of no receiver; the nearest is \"truck1/roof\"");
  config = drive(folder);
  config.mounts[0].on = "trck*";
  check_contains(error_of<ConfigError>(config), "the nearest is \"truck");
  config = drive(folder);
  config.transmitters[0].name = "turner/roof";
  check_contains(error_of<ConfigError>(config), "\"turner/roof\" is there already");
  config = drive(folder);
  config.time = {.start_s = 5, .end_s = std::nullopt, .step_s = 0};
  check_contains(error_of<ConfigError>(config), "the end must not be before the beginning");
  Config still;
  still.transmitters = {end("rsu", {0, 0, 6})};
  still.tracks = {{"ego", "passenger", {{3, 0, 0, 0}}}};
  still.mounts = {mount("roof", "*", "receiver", {0, 0, 1})};
  CHECK(World(still, static_scene()).frame_count() == 1);
  CHECK(World(still, static_scene()).time_s(0) == 3);
  still.time.end_s = 4;
  check_contains(error_of<ConfigError>(still), "time.step_s is not given");
}

TEST_CASE("reach holds every end and every corner of every frame, and is not far off") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.tracks = {{"swing", "truck", {{0, 0, 0, 0}, {0.5, 80, 10, 0}, {0.7, 80, 10, 0}, {2, 0, 0, 3}}}};
  config.time.step_s = 0.013;
  const World world(config, static_scene());
  double largest = 0;
  const auto add = [&](const glm::dvec3& p) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  };
  for (uint32_t frame = 0; frame < world.frame_count(); ++frame) {
    const WorldState state = world.state(frame);
    for (const EndState& e : state.transmitters) add(e.position_m);
    for (size_t i = 0; i < state.instances.size(); ++i)
      for (const glm::dvec3& v : world.models()[world.instances()[i].model].vertices)
        add(state.instances[i].position_m + state.instances[i].rotation * v);
  }
  CHECK(world.reach_m() >= largest);
  CHECK(world.reach_m() <= largest + 40);
}

TEST_CASE("bounds of a track hold the cubic where it leaves the box of its samples") {
  Track track{"x", 0, {}, {0}};
  for (const double time_s : {0.0, 2.0}) {
    Sample sample;
    sample.time_s = time_s;
    sample.position_m = {time_s, 0, 5};
    sample.yaw_rad = sample.pitch_rad = 0;
    sample.velocity_m_s = {10, time_s > 0 ? 8 : -8, 0};  // y = 4 t (t - 2), down to -4
    track.samples.push_back(sample);
  }
  const Bounds bounds = bounds_of(track);
  glm::dvec3 lower(1e9), upper(-1e9);
  for (int k = 0; k <= 1000; ++k) {
    const glm::dvec3 p = pose_at(track, 0.002 * k)->position_m;
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  CHECK(upper.x > 2.1);
  CHECK(lower.y == doctest::Approx(-4));
  CHECK(glm::all(glm::lessThanEqual(bounds.lower, lower)));
  CHECK(glm::all(glm::greaterThanEqual(bounds.upper, upper)));
  CHECK(bounds.lower.z == 5);
}

TEST_CASE("generated traffic drives a world of its own") {
  Config config;
  config.trajectories.generate = "--seed 1 --blocks 4 --vehicles 10 --seconds 1 --step 0.1";
  config.transmitters = {end("rsu", {0, 0, 6})};
  config.mounts = {mount("roof", "*", "receiver", {0, 0, 1.6})};
  const World world(config, static_scene());
  CHECK(world.frame_count() == 11);
  CHECK(world.instances().size() == 10);
  CHECK(world.state(10).links.size() == 10);
  config.trajectories.generate = "--vehicle 10";
  CHECK_THROWS_AS(World(config, static_scene()), ConfigError);
}

TEST_CASE("patterns") {
  for (const auto& [pattern, name, expected] : std::vector<std::tuple<std::string, std::string, bool>>{
           {"*", "", true},          {"", "", true},        {"", "a", false},      {"a*c", "abbc", true},
           {"a*c", "abcb", false},   {"a?c", "abc", true},  {"a?c", "ac", false},  {"*a*a*", "banana", true},
           {"*a?a", "banana", true}, {"[a]", "[a]", true},  {"[a]", "a", false},   {"veh*/roof", "veh1/x/roof", true},
           {"?", "", false},         {"**", "abc", true},   {"abc", "ab", false},  {"*ab", "aab", true}}) {
    CAPTURE(pattern);
    CAPTURE(name);
    CHECK(matches(pattern, name) == expected);
  }
}
