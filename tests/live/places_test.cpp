// SPDX-License-Identifier: Apache-2.0
// Live worlds without a socket: the same channels as a drive of the same poses, places, speeds, and refused messages.
// The oracle of channels is run_frame() on tracks; that of Doppler shifts the closed form of a line of sight.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <string>
#include <tuple>

#include "wavetracer/live.hpp"

using namespace wavetracer;

namespace {

Config city(bool reuse) {
  Config config;
  config.scene.generate = "--seed 1 --blocks 2x2";
  config.transmitters.push_back({.name = "rsu", .position_m = {8, 8, 6}});
  config.mounts.push_back({.name = "roof", .on = "passenger", .offset_m = {0, 0, 1.6}});
  config.trace.rays = 20000;
  config.trace.max_depth = 3;
  config.trace.reuse = reuse;
  return config;
}

Config live_city(bool reuse) {
  Config config = city(reuse);
  config.live_vehicles = {{"passenger", 3}, {"truck", 1}};
  return config;
}

LivePose pose(const std::string& id, double x, double y, const std::string& type = "passenger") {
  return {.id = id, .type = type, .position_m = {x, y, 0}, .velocity_m_s = {}, .angular_velocity_rad_s = {}};
}

std::string code_of(Simulation& simulation, LiveTraffic& traffic, const std::vector<LivePose>& poses) {
  try {
    simulation.run_poses(traffic, 0, poses);
  } catch (const PoseError& error) {
    return error.code;
  }
  return "";
}

// Rows of all paths by the names of their ends: sorted, so that the numbers of ends do not matter.
using Row = std::tuple<std::string, std::string, double, double, double, double>;
std::vector<Row> rows(const Paths& p, const auto& tx_name, const auto& rx_name) {
  std::vector<Row> out;
  for (size_t i = 0; i < p.size(); ++i)
    out.emplace_back(tx_name(p.tx[i]), rx_name(p.rx[i]), p.delay_s[i], p.a[i][0].real(), p.a[i][0].imag(),
                     p.doppler_hz[i]);
  std::ranges::sort(out);
  return out;
}

// Delay and Doppler shift of every path, by its ends and surfaces: the same sequences at neighbouring instants.
auto named(const LiveFrame& f) {
  std::map<std::tuple<std::string, std::string, std::vector<uint32_t>>, std::pair<double, double>> out;
  const Paths& p = f.result.paths;
  for (size_t row = 0; row < p.size(); ++row) {
    std::vector<uint32_t> surfaces(p.vertex_surface.begin() + static_cast<ptrdiff_t>(p.vertex_offset[row]),
                                   p.vertex_surface.begin() + static_cast<ptrdiff_t>(p.vertex_offset[row + 1]));
    out[{f.transmitters[p.tx[row]], f.receivers[p.rx[row]], surfaces}] = {p.delay_s[row], p.doppler_hz[row]};
  }
  return out;
}

}  // namespace

// Equality is up to rounding here, since poses are taken from the placements of the drive; protocol_test.py compares
// bits.
TEST_CASE("live poses give the channels of a drive of the same poses") {
  Config drive = city(false);
  drive.tracks = {{.id = "b", .waypoints = {{0, -3, -20, 0}, {1, -3, -30, 0}}},
                  {.id = "a", .waypoints = {{0, 3, -60, 0}, {1, 3, -50, 0}}},
                  {.id = "t", .type = "truck", .waypoints = {{0, -20, 3, 0}, {1, -28, 3, 0}}}};
  drive.time = {.start_s = 0, .end_s = 1, .step_s = 0.5};
  Simulation recorded(drive);
  Simulation live(live_city(false));
  LiveTraffic traffic;
  const glm::dvec3 origin_m = recorded.scene().origin_m;
  for (uint32_t k = 0; k < 3; ++k) {
    const FrameResult expected = recorded.run_frame(k);
    std::vector<LivePose> poses;
    for (size_t i = 0; i < expected.world.instances.size(); ++i) {
      const Placement& placement = expected.world.instances[i];
      const Instance& instance = recorded.instances()[i];
      const glm::dvec3 arm_m = recorded.models()[instance.model].origin_m;
      poses.push_back({.id = instance.id,
                       .type = instance.type,
                       .position_m = origin_m + placement.position_m - placement.rotation * arm_m,
                       .orientation = glm::quat_cast(placement.rotation),
                       .velocity_m_s = placement.velocity_m_s,
                       .angular_velocity_rad_s = placement.angular_velocity_rad_s});
      poses.back().position_m = glm::round(poses.back().position_m * 1e6) / 1e6;  // the track's own, to a micrometre
    }
    const LiveFrame frame = live.run_poses(traffic, expected.world.time_s, poses);
    const auto of_config = [&](const std::vector<RadioEnd>& ends) { return [&](uint32_t i) { return ends[i].name; }; };
    const auto of_frame = [](const std::vector<std::string>& names) { return [&](uint32_t i) { return names[i]; }; };
    const auto a =
        rows(expected.paths, of_config(recorded.config().transmitters), of_config(recorded.config().receivers));
    const auto b = rows(frame.result.paths, of_frame(frame.transmitters), of_frame(frame.receivers));
    REQUIRE(a.size() == b.size());
    CHECK(a.size() > 10);
    for (size_t i = 0; i < a.size(); ++i) {
      CHECK(std::get<0>(a[i]) == std::get<0>(b[i]));
      CHECK(std::get<1>(a[i]) == std::get<1>(b[i]));
      CHECK(std::abs(std::get<2>(a[i]) - std::get<2>(b[i])) < 1e-17);  // 3 nm
      const std::complex<double> x(std::get<3>(a[i]), std::get<4>(a[i])), y(std::get<3>(b[i]), std::get<4>(b[i]));
      CHECK(std::abs(x - y) <= 1e-9 * std::abs(x));
      CHECK(std::abs(std::get<5>(a[i]) - std::get<5>(b[i])) < 1e-6);
    }
  }
}

TEST_CASE("a live frame that is given up leaves nothing of its rays: the next one is cold") {
  Simulation live(live_city(true));
  LiveTraffic traffic;
  const std::vector poses{pose("x", 0, -50)};
  const LiveFrame cold = live.run_poses(traffic, 0, poses), warm = live.run_poses(traffic, 0.1, poses);
  CHECK(5 * warm.result.counts.rays < cold.result.counts.rays);
  live.observe([](const FrameProgress& at) { return at.stage != "paths"; });
  CHECK_THROWS_AS(live.run_poses(traffic, 0.2, poses), FrameStopped);
  live.observe({});
  const LiveFrame next = live.run_poses(traffic, 0.3, poses);
  CHECK(next.result.counts.rays == cold.result.counts.rays);
  CHECK(next.result.paths.delay_s == cold.result.paths.delay_s);
}

TEST_CASE("places: kept while a vehicle stays, given to others after it; names are those of the ids") {
  Simulation live(live_city(true));
  LiveTraffic traffic;
  live.run_poses(traffic, 0, std::vector{pose("x", 0, -50), pose("y", 0, 50)});
  const uint32_t x = traffic.vehicles.at("x").place, y = traffic.vehicles.at("y").place;
  live.run_poses(traffic, 0.1, std::vector{pose("y", 1, 50), pose("z", 50, 0)});
  CHECK(traffic.vehicles.at("y").place == y);
  CHECK(traffic.vehicles.at("z").place == x);  // the first free place
  CHECK(traffic.vehicles.size() == 2);
  const LiveFrame frame = live.run_poses(traffic, 0.2, std::vector{pose("z", 50, 0), pose("lorry", -50, 0, "truck")});
  std::map<std::string, int> names;
  for (const Link& link : frame.result.world.links) names[frame.receivers[link.rx]]++;
  CHECK(names == std::map<std::string, int>{{"z/roof", 1}});  // from rsu; the truck carries no antenna
}

TEST_CASE("a place that another vehicle takes keeps nothing that is not so: paths are those of a cold frame") {
  Simulation live(live_city(true)), cold(live_city(true));
  LiveTraffic traffic, fresh;
  for (int k = 0; k < 5; ++k) live.run_poses(traffic, 0.1 * k, std::vector{pose("a", -40.0 + k, -3), pose("b", 20, 3)});
  const std::vector<LivePose> now{pose("c", 3, -70), pose("d", -60, 3)};
  const LiveFrame warm = live.run_poses(traffic, 0.5, now), first = cold.run_poses(fresh, 0.5, now);
  const auto name = [](const std::vector<std::string>& names) { return [&](uint32_t i) { return names[i]; }; };
  const auto found = rows(warm.result.paths, name(warm.transmitters), name(warm.receivers));
  const auto all = rows(first.result.paths, name(first.transmitters), name(first.receivers));
  // Every strong path of the cold frame is there, with a Doppler shift of zero for a vehicle that has just arrived.
  for (const Row& row : found) CHECK(std::get<5>(row) == 0);
  size_t shared = 0;
  for (const Row& row : all)
    shared += std::ranges::any_of(found, [&](const Row& r) {
      return std::get<0>(r) == std::get<0>(row) && std::get<1>(r) == std::get<1>(row) &&
             std::abs(std::get<2>(r) - std::get<2>(row)) < 1e-15;
    });
  CHECK(shared >= all.size() * 9 / 10);
  REQUIRE(!all.empty());
}

TEST_CASE("velocity from the last two poses shifts the line of sight as the closed form says") {
  Simulation live(live_city(true));
  LiveTraffic traffic;
  live.run_poses(traffic, 0, std::vector{pose("a", 0, -40)});
  const LiveFrame frame = live.run_poses(traffic, 0.5, std::vector{pose("a", 0, -30)});  // 20 m/s towards the crossing
  const glm::dvec3 rsu_m(8, 8, 6), roof_m(0, -30, 1.6);
  const double towards_m_s = glm::dot(glm::dvec3(0, 20, 0), glm::normalize(rsu_m - roof_m));
  const double expected_hz = 5.9e9 / 299792458.0 * towards_m_s;
  const Paths& paths = frame.result.paths;
  size_t sights = 0;
  for (size_t i = 0; i < paths.size(); ++i)
    if (paths.depth[i] == 0) {
      ++sights;
      CHECK(paths.doppler_hz[i] == doctest::Approx(expected_hz).epsilon(1e-9));
    }
  CHECK(sights == 1);
  // A jump of 200 m in 0.1 s has no speed.
  const LiveFrame jumped = live.run_poses(traffic, 0.6, std::vector{pose("a", -60, 3), pose("b", 60, 3)});
  for (const double shift_hz : jumped.result.paths.doppler_hz) CHECK(std::abs(shift_hz) < 1500 * 5.9 / 0.3);
}

TEST_CASE("what is refused changes nothing") {
  Simulation live(live_city(true));
  LiveTraffic traffic;
  live.run_poses(traffic, 0, std::vector{pose("a", 0, -40)});
  CHECK(code_of(live, traffic, {pose("b", 0, 0, "tank")}) == "unknown_type");
  CHECK(code_of(live, traffic, {pose("a", 0, 0, "truck")}) == "type_changed");
  CHECK(code_of(live, traffic, {pose("b", 0, 0), pose("b", 9, 0)}) == "duplicate_id");
  CHECK(code_of(live, traffic, {pose("b", 0, 0, "truck"), pose("c", 0, 9, "truck")}) == "no_place");
  CHECK(code_of(live, traffic, {pose("b", 1e4, 0)}) == "out_of_bounds");
  CHECK(code_of(live, traffic, {pose("b", std::nan(""), 0)}) == "out_of_bounds");
  LivePose wrong = pose("b", 0, 0);
  wrong.orientation = {0, 0, 0, 0};
  CHECK(code_of(live, traffic, {wrong}) == "bad_value");
  wrong = pose("b", 0, 0);
  wrong.velocity_m_s = glm::dvec3(INFINITY, 0, 0);
  CHECK(code_of(live, traffic, {wrong}) == "bad_value");
  CHECK(traffic.vehicles.size() == 1);
  CHECK(traffic.frames == 1);
  Config none = city(true);
  none.mounts.clear();
  none.receivers.push_back({.name = "rx"});
  Simulation still(none);
  CHECK_THROWS_AS(still.run_poses(traffic, 0, {}), ConfigError);
  Config twice = live_city(true);
  twice.live_vehicles.push_back({"truck", 2});
  CHECK_THROWS_AS(Simulation(twice, ""), ConfigError);
  Config both = live_city(true);
  both.tracks = {{.id = "b", .waypoints = {{0, -40, -3, 0}, {1, -30, -3, 0}}}};
  CHECK_THROWS_AS(Simulation(both, ""), ConfigError);
}

TEST_CASE("between two poses: cars on their cubic, with the Doppler shifts of their delays, and no rays") {
  Config config = live_city(true);
  config.trace.discover_every_s = 0.2;
  Simulation live(config);
  LiveTraffic traffic;
  LivePose a = pose("a", 0, -40), b = pose("b", 30, -3);
  a.velocity_m_s = {0, 15, 0};
  b.velocity_m_s = {-8, 0, 0};
  live.run_poses(traffic, 10, std::vector{a, b, pose("gone", 60, 3)});
  a.position_m.y += 1.6;  // faster and faster, and turning
  a.velocity_m_s = {0.5, 17, 0};
  a.orientation = {std::cos(0.04), 0, 0, std::sin(0.04)};
  b.position_m.x -= 0.8;
  const LiveFrame frame = live.run_poses(traffic, 10.1, std::vector{a, b, pose("come", -60, 3)});
  REQUIRE(frame.result.counts.rays > 0);  // a vehicle has arrived
  const LiveTraffic before = traffic;

  const double step_s = 1e-3, time_s = 10.06;
  const LiveFrame middle = live.run_between(traffic, time_s);
  CHECK(middle.result.counts.rays == 0);
  CHECK(middle.result.world.time_s == time_s);
  const auto earlier = named(live.run_between(traffic, time_s - step_s));
  const auto at = named(middle), later = named(live.run_between(traffic, time_s + step_s));
  size_t compared = 0;
  for (const auto& [key, values] : at) {
    CHECK(std::get<0>(key) != "come/roof");
    CHECK(std::get<1>(key) != "gone/roof");
    if (!earlier.contains(key) || !later.contains(key)) continue;
    const double rate = (later.at(key).first - earlier.at(key).first) / (2 * step_s);
    CHECK(-5.9e9 * rate == doctest::Approx(values.second).epsilon(1e-4));
    ++compared;
  }
  CHECK(compared > 20);

  // At the time of a frame nothing changes.
  const auto last = named(live.run_between(traffic, 10.1)), same = named(frame);
  REQUIRE(last.size() == same.size());
  for (const auto& [key, values] : same) {
    REQUIRE(last.contains(key));
    CHECK(last.at(key).first == doctest::Approx(values.first).epsilon(1e-14));
  }
  const auto beside = named(live.run_between(traffic, std::nextafter(10.1, 11)));  // a rounding after it
  CHECK(beside.size() == same.size());
  CHECK(traffic.frames == before.frames);
  CHECK(traffic.time_s == before.time_s);
  for (const double outside : {9.999, 10.101, std::nan("")}) {
    CAPTURE(outside);
    CHECK_THROWS_AS(live.run_between(traffic, outside), PoseError);
  }
  LiveTraffic fresh;
  CHECK_THROWS_AS(live.run_between(fresh, 0), PoseError);
  live.run_poses(fresh, 0, std::vector{a});
  CHECK_THROWS_AS(live.run_between(fresh, 0), PoseError);
}
