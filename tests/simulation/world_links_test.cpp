// SPDX-License-Identifier: Apache-2.0
// Tests the links of a world against counted pairs, what is refused, how far links reach, and generated traffic.
#include "simulation/world_links.hpp"
#include "simulation/name_pattern.hpp"
#include "simulation/world_fixture.hpp"
#include "simulation/world_trajectories.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("links by name, kind, vehicle and distance") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.receivers = {end("base", {0, 100, 6})};
  config.mounts.push_back(mount("bumper", "truck*", "receiver", {3.5, 0, 0.5}));
  // tx: rsu, turner/roof, truck1/roof; rx: base, turner/roof, truck1/roof, truck1/bumper
  const auto links = [&](const LinksConfig& rules) {
    config.links = rules;
    return make_world(config, static_scene()).state(10).links;
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
  const World world = make_world(config, static_scene());
  CHECK(world.state(0).links == std::vector<Link>{{0, 0}, {0, 1}, {1, 0}, {1, 1}});
  CHECK(world.twins.receiver_of_transmitter == std::vector<uint32_t>{no_end, 0});
  CHECK(world.twins.transmitter_of_receiver == std::vector<uint32_t>{1, no_end});
}

TEST_CASE("a station is a transmitter and a receiver of one name, which are no link to each other") {
  Config config;
  config.transmitters = {end("mast", {9, 0, 6})};
  config.receivers = {end("car", {5, 0, 1.5})};
  config.stations = {end("rsu", {0, 0, 6}), end("other", {30, 0, 6})};
  config.stations[0].velocity_m_s = {1, 2, 3};
  config.receiver_grids = {{.name = "g", .x_min_m = 0, .x_max_m = 2, .y_min_m = 0, .y_max_m = 1, .step_m = 1}};
  const World world = make_world(config, static_scene());
  const auto names = [](const std::vector<RadioEnd>& ends) {
    std::vector<std::string> out;
    for (const RadioEnd& end : ends) out.push_back(end.name);
    return out;
  };
  CHECK(names(world.transmitters.ends) == std::vector<std::string>{"mast", "rsu", "other"});
  CHECK(names(world.receivers.ends) == std::vector<std::string>{"car", "rsu", "other", "g/0,0", "g/1,0"});
  CHECK(world.twins.receiver_of_transmitter == std::vector<uint32_t>{no_end, 1, 2});
  CHECK(world.twins.transmitter_of_receiver == std::vector<uint32_t>{no_end, 1, 2, no_end, no_end});
  const WorldState state = world.state(0);
  CHECK(state.transmitters[1].position_m == state.receivers[1].position_m);
  CHECK(state.transmitters[1].velocity_m_s == glm::dvec3(1, 2, 3));
  CHECK(state.receivers[1].velocity_m_s == glm::dvec3(1, 2, 3));
  std::vector<Link> expected;
  for (uint32_t tx = 0; tx < 3; ++tx)
    for (uint32_t rx = 0; rx < 5; ++rx)
      if (tx == 0 || tx != rx) expected.push_back({tx, rx});
  CHECK(state.links == expected);
  config.links.transmitters = {"rsu"};  // a name chooses each role by itself
  config.links.receivers = {"other"};
  CHECK(make_world(config, static_scene()).state(0).links == std::vector<Link>{{1, 2}});
}

TEST_CASE("two vehicles in one place: their antennas are linked, and none is to itself") {
  Config config;
  config.tracks = {{.id = "a", .waypoints = {{0, 3, 4, 0}}}, {.id = "b", .waypoints = {{0, 3, 4, 0}}}};
  config.mounts = {mount("roof", "*", "both", {0, 0, 1.6})};
  config.links.same_vehicle = true;
  CHECK(make_world(config, static_scene()).state(0).links == std::vector<Link>{{0, 1}, {1, 0}});
}

TEST_CASE("more pairs than a drive or a frame can have are an error that says so") {
  const auto side = [](size_t ends) {
    return LinkSide{std::vector<RadioEnd>(ends, RadioEnd{.name = "a"}), std::vector<uint32_t>(ends, 0)};
  };
  const auto limit = [](const std::string& said) {
    return doctest::Contains((said + " pairs, the limit: mount antennas on fewer vehicles").c_str());
  };
  CHECK_THROWS_WITH_AS(LinkRules({}, side(300'000), side(300'000)),
                       limit("300000 transmitters and 300000 receivers of all frames are more than 68719476736"),
                       RuntimeError);
  const LinkRules rules({}, side(100'000), side(100'000));
  std::vector<EndState> ends(100'000, EndState{.present = false});
  CHECK(rules(ends, ends).empty());
  for (size_t i = 0; i < 40'000; ++i) ends[i].present = true;
  CHECK_THROWS_WITH_AS(rules(ends, ends),
                       limit("40000 transmitters and 40000 receivers of one frame are more than 1073741824"),
                       RuntimeError);
}

TEST_CASE("types, names and steps that are not known") {
  const TemporaryFolder folder;
  const std::string odd = two_vehicles("spaceship");
  check_contains(error_of<InputError>(drive(folder, odd)), "the vehicle type 'spaceship' is unknown");
  Config config = drive(folder, odd);
  config.trajectories.default_type = "truck";
  const World world = make_world(config, static_scene());
  CHECK(world.fleet.instances[1].type == "spaceship");
  CHECK(world.fleet.models.size() == 2);
  REQUIRE_FALSE(world.warnings.empty());
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
                 "links.receivers: \"truck1/rof\" is not the name of a receiver; the nearest is \"truck1/roof\"");
  config = drive(folder);
  config.mounts[0].on = "trck*";
  check_contains(error_of<ConfigError>(config), "the nearest is \"truck");
  config = drive(folder);
  config.transmitters[0].name = "turner/roof";
  check_contains(error_of<ConfigError>(config), "\"turner/roof\" exists already");
  config = drive(folder);
  config.time = {.start_s = 5, .end_s = std::nullopt, .step_s = std::nullopt};
  check_contains(error_of<ConfigError>(config), "[time] begins at 5 s, and the trajectories go from 0 to 2 s");
  Config still;
  still.transmitters = {end("rsu", {0, 0, 6})};
  still.tracks = {{"ego", "passenger", {{3, 0, 0, 0}}}};
  still.mounts = {mount("roof", "*", "receiver", {0, 0, 1})};
  CHECK(make_world(still, static_scene()).clock.frame_count() == 1);
  CHECK(make_world(still, static_scene()).clock.time_s(0) == 3);
  still.time.end_s = 4;
  check_contains(error_of<ConfigError>(still), "time.step_s is not given");
}

TEST_CASE("reach holds every end and every corner of every frame, and is not far off") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  config.tracks = {{"swing", "truck", {{0, 0, 0, 0}, {0.5, 80, 10, 0}, {0.7, 80, 10, 0}, {2, 0, 0, 3}}}};
  config.time.step_s = 0.013;
  const World world = make_world(config, static_scene());
  double largest = 0;
  const auto add = [&](const glm::dvec3& p) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  };
  for (uint32_t frame = 0; frame < world.clock.frame_count(); ++frame) {
    const WorldState state = world.state(frame);
    for (const EndState& e : state.transmitters) add(e.position_m);
    for (size_t i = 0; i < state.instances.size(); ++i)
      for (const glm::dvec3& v : world.fleet.models[world.fleet.instances[i].model].vertices)
        add(state.instances[i].position_m + state.instances[i].rotation * v);
  }
  CHECK(world.reach_m >= largest);
  CHECK(world.reach_m <= largest + 40);
}

TEST_CASE("positions beyond 1000 km from the middle of the scene are errors by name, whoever gave them") {
  const TemporaryFolder folder;
  Config config = drive(folder);
  for (const double far_m : {1.1e6, -1e27, 1e300}) {
    CAPTURE(far_m);
    config.transmitters = {end("rsu", {0, far_m, 6})};
    check_contains(error_of<ConfigError>(config), "transmitter \"rsu\" is at [0, ");
    config.transmitters = {end("rsu", {0, 0, 6})};
    config.receivers = {end("base", {0, 0, far_m})};
    check_contains(error_of<ConfigError>(config), "receiver \"base\" is at [0, 0, ");
    config.receivers.clear();
    config.receiver_grids = {{.name = "streets", .x_min_m = far_m, .x_max_m = far_m, .y_min_m = 0, .y_max_m = 1}};
    check_contains(error_of<ConfigError>(config), "receiver \"streets/0,0\" is at [");
    config.receiver_grids.clear();
    config.mounts[0].offset_m = {far_m, 0, 0};
    check_contains(error_of<ConfigError>(config), "vehicle \"turner\": an antenna on it");
    config.mounts[0].offset_m = {0, 0, 1.6};
    config.tracks = {{"ego", "passenger", {{0, 0, 0, 0}, {1, far_m, 0, 0}}}};
    check_contains(error_of<InputError>(config), "vehicle \"ego\" at 1 s is at [");
    config.tracks.clear();
    config.trajectories.offset_m = {far_m, 0, 0};
    check_contains(error_of<InputError>(config), "check trajectories.offset_m and trajectories.scale");
    config.trajectories.offset_m = {0, 0, 0};
  }
  config.transmitters = {end("rsu", {std::nan(""), 0, 6})};
  check_contains(error_of<ConfigError>(config), "transmitter \"rsu\" is at [nan");
  config.transmitters = {end("rsu", {9.9e5, 0, 6})};
  CHECK(make_world(config, static_scene()).reach_m == 9.9e5 - 100);
  config.trajectories.file = folder.write("fast.csv", "time,id,x,y,speed\n0,a,0,0,0\n1,a,1,0,9e7\n").string();
  config.mounts[0].on = "a";
  check_contains(error_of<InputError>(config), "vehicle \"a\": between two samples its speed takes it ");
}

TEST_CASE("frames outside of the trajectories: all of them are an error, some a warning with their number") {
  const TemporaryFolder folder;
  Config config = drive(folder);  // 0 to 2 s in steps of 0.1 s
  const auto warning = [&](const TimeConfig& time) {
    config.time = time;
    const World world = make_world(config, static_scene());
    for (const std::string& text : world.warnings)
      if (text.find("frames have no vehicle") != text.npos) return text;
    return std::string();
  };
  const auto none = std::nullopt;
  CHECK(warning({}).empty());
  CHECK(warning({.start_s = 0.5, .end_s = 1.5}).empty());
  CHECK(warning({.start_s = 0, .end_s = 2, .step_s = 0.3}).empty());
  CHECK(warning({.start_s = 2, .end_s = none}).empty());
  CHECK(warning({.start_s = -0.5, .end_s = none}) ==
        "5 of 26 frames have no vehicle: [time] begins at -0.5 s, and the trajectories go from 0 to 2 s");
  CHECK(warning({.start_s = none, .end_s = 3, .step_s = 0.5}) ==
        "2 of 7 frames have no vehicle: [time] ends at 3 s, and the trajectories go from 0 to 2 s");
  CHECK(warning({.start_s = -1, .end_s = 4, .step_s = 1}) ==
        "3 of 6 frames have no vehicle: [time] goes from -1 to 4 s, and the trajectories go from 0 to 2 s");
  config.time = {.start_s = -9, .end_s = -1};
  check_contains(error_of<ConfigError>(config), "[time] goes from -9 to -1 s, and the trajectories go from 0 to 2 s");
  config.time = {.start_s = none, .end_s = -1};
  check_contains(error_of<ConfigError>(config), "[time] ends at -1 s, and the trajectories go from 0 to 2 s");
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
  const World world = make_world(config, static_scene());
  CHECK(world.clock.frame_count() == 11);
  CHECK(world.fleet.instances.size() == 10);
  CHECK(world.state(10).links.size() == 10);
  config.trajectories.generate = "--vehicle 10";
  CHECK_THROWS_AS(make_world(config, static_scene()), ConfigError);
}

TEST_CASE("patterns") {
  for (const auto& [pattern, name, expected] :
       std::vector<std::tuple<std::string, std::string, bool>>{{"*", "", true},
                                                               {"", "", true},
                                                               {"", "a", false},
                                                               {"a*c", "abbc", true},
                                                               {"a*c", "abcb", false},
                                                               {"a?c", "abc", true},
                                                               {"a?c", "ac", false},
                                                               {"*a*a*", "banana", true},
                                                               {"*a?a", "banana", true},
                                                               {"[a]", "[a]", true},
                                                               {"[a]", "a", false},
                                                               {"veh*/roof", "veh1/x/roof", true},
                                                               {"?", "", false},
                                                               {"**", "abc", true},
                                                               {"abc", "ab", false},
                                                               {"*ab", "aab", true}}) {
    CAPTURE(pattern);
    CAPTURE(name);
    CHECK(matches(pattern, name) == expected);
  }
}
