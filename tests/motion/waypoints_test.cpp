// SPDX-License-Identifier: Apache-2.0
// Waypoints: tracks of positions alone, with stops, corners and climbs.
// Positions are in scene coordinates; nothing is cut however far apart waypoints are.
#include <array>
#include <cmath>
#include <limits>

#include "motion/pose.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

const VehicleType car_type{"car", 4, 2, 1.5}, bus_type{"bus", 12, 2.5, 3.4};

Trajectories connect(std::vector<Waypoint> waypoints) {
  const std::array tracks = {WaypointTrack{"a", car_type, std::move(waypoints)}};
  return connect_waypoints(tracks);
}

}  // namespace

TEST_CASE("a straight drive at constant speed, up a ramp, is exact at every time") {
  const glm::dvec3 start(1e5, -2e5, 3), velocity(12, -5, 0.5);
  const Trajectories t =
      connect({{0, start}, {1, start + velocity}, {10, start + 10.0 * velocity}, {100, start + 100.0 * velocity}});
  CHECK(t.tracks.at(0).segments.size() == 1);
  for (double time = 0; time <= 100; time += 0.37) {
    CAPTURE(time);
    const auto pose = pose_at(t.tracks[0], time);
    REQUIRE(pose);
    check_near(pose->position_m, start + time * velocity, 1e-10);
    check_near(pose->velocity_m_s, velocity, 1e-9);
    check_near(pose->angular_velocity_rad_s, {0, 0, 0}, 1e-12);
    check_near(pose->orientation * glm::dvec3(1, 0, 0), velocity / std::sqrt(169.25), 1e-12);
  }
}

TEST_CASE("straight up") {
  const Trajectories t = connect({{0, {1, 2, 0}}, {1, {1, 2, 3}}, {2, {1, 2, 6}}});
  check_near(pose_at(t.tracks.at(0), 0.5)->position_m, {1, 2, 1.5});
  check_near(pose_at(t.tracks[0], 0.5)->velocity_m_s, {0, 0, 3});
}

TEST_CASE("at a stop the vehicle stands, and keeps its heading") {
  const Trajectories t = connect({{0, {0, 0, 0}}, {5, {0, 10, 0}}, {9, {0, 10, 0}}, {14, {10, 10, 0}}});
  for (double time = 5; time <= 9; time += 0.25) {
    const auto pose = pose_at(t.tracks.at(0), time);
    check_near(pose->position_m, {0, 10, 0});
    check_near(pose->velocity_m_s, {0, 0, 0});
  }
  check_near(pose_at(t.tracks[0], 5)->orientation * glm::dvec3(1, 0, 0), {0, 1, 0});
  check_near(pose_at(t.tracks[0], 14)->orientation * glm::dvec3(1, 0, 0), {1, 0, 0});
  for (double time = 0; time <= 5; time += 0.25) CHECK(pose_at(t.tracks[0], time)->position_m.y <= 10);  // no overshoot
}

TEST_CASE("types are shared, tracks ordered, a single waypoint is a single instant") {
  const std::array tracks = {WaypointTrack{"late", car_type, {{3, {0, 0, 0}}, {4, {1, 0, 0}}}},
                             WaypointTrack{"b", bus_type, {{0, {0, 0, 0}}, {2, {1, 0, 0}}}},
                             WaypointTrack{"a", car_type, {{0, {7, 8, 9}}}}};
  const Trajectories t = connect_waypoints(tracks);
  REQUIRE(t.tracks.size() == 3);
  CHECK(t.tracks[0].id == "a");
  CHECK(t.tracks[1].id == "b");
  CHECK(t.tracks[2].id == "late");
  CHECK(t.types.size() == 2);
  CHECK(t.types[t.tracks[1].type].name == "bus");
  CHECK(t.first_time_s == 0);
  CHECK(t.last_time_s == 4);
  check_near(pose_at(t.tracks[0], 0)->position_m, {7, 8, 9});
  CHECK_FALSE(pose_at(t.tracks[0], 0.1));
  CHECK(connect_waypoints({}).tracks.empty());
}

TEST_CASE("errors name the waypoint") {
  const auto fails = [](std::vector<Waypoint> waypoints, const char* message) {
    CAPTURE(message);
    CHECK_THROWS_WITH_AS(connect(std::move(waypoints)), Contains(message), InputError);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  fails({}, "'a' has no waypoint");
  fails({{0, {0, 0, 0}}, {1, {0, nan, 0}}}, "waypoint 1 of 'a': nan is not a finite number");
  fails({{nan, {0, 0, 0}}}, "waypoint 0 of 'a': nan is not a finite number");
  fails({{0, {0, 0, 0}}, {0, {1, 0, 0}}}, "waypoint 1 of 'a': time must increase, but 0 s follows 0 s");
  fails({{0, {0, 0, 0}}, {-1, {1, 0, 0}}}, "but -1 s follows 0 s");
  const std::array twice = {WaypointTrack{"a", car_type, {{0, {0, 0, 0}}}},
                            WaypointTrack{"a", car_type, {{0, {0, 0, 0}}}}};
  CHECK_THROWS_WITH_AS(connect_waypoints(twice), Contains("'a' is defined twice"), InputError);
}
