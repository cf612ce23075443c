// SPDX-License-Identifier: Apache-2.0
// Ways and turns along a vehicle's own axes: closed forms on a line and on a circle, fine sums, gaps and ends.
#include "motion/travel.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "motion/pose.hpp"
#include "motion/track_motion.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Track bends() {
  Track track{"a", 0, {}, {0}};
  double yaw = 0.3, time_s = 2;
  glm::dvec3 p(100, 50, 0);
  for (int k = 0; k < 12; ++k) {
    const double speed = 8 + 3 * std::sin(k), pitch = 0.03 * std::cos(2.0 * k);
    track.samples.push_back(sample_at(time_s, p, yaw, pitch, speed));
    p += 0.5 * speed * heading(yaw, pitch);
    yaw += 0.2 * std::cos(k);
    time_s += 0.5;
  }
  return track;
}

}  // namespace

TEST_CASE("a way straight on and on a circle") {
  Track line{"a", 0, {}, {0}};
  for (int k = 0; k < 5; ++k) line.samples.push_back(sample_at(k, {3.0 * k, 4.0 * k, 0}, std::atan2(4, 3), 0, 5));
  const Travel straight(line);
  for (const double time_s : {0.0, 0.7, 2.0, 3.999}) {
    const Travelled now = straight.at(line, time_s);
    check_near(now.way_m, {5 * time_s, 0, 0}, 1e-13);
    check_near(now.turn_rad, {0, 0, 0}, 1e-15);
    check_near(now.velocity_m_s, {5, 0, 0}, 1e-13);
  }
  constexpr double radius_m = 20, speed_m_s = 6, step_s = 0.02;
  Track ring{"b", 0, {}, {0}};
  for (int k = 0; k < 400; ++k) {
    const double angle = speed_m_s * step_s * k / radius_m;
    ring.samples.push_back(sample_at(step_s * k, radius_m * glm::dvec3(std::cos(angle), std::sin(angle), 0),
                                     std::remainder(angle + pi / 2, 2 * pi), 0, speed_m_s));
  }
  const Travelled now = Travel(ring).at(ring, 7.33);
  check_near(now.way_m, {speed_m_s * 7.33, 0, 0}, 1e-6);
  check_near(now.turn_rad, {0, 0, speed_m_s * 7.33 / radius_m}, 1e-9);
  check_near(now.rate_rad_s, {0, 0, speed_m_s / radius_m}, 1e-6);
}

TEST_CASE("ways are the sums of small steps, and their derivatives are the velocities") {
  const Track track = bends();
  const Travel travel(track);
  glm::dvec3 way_m(0), turn_rad(0);
  constexpr int steps = 200000;
  constexpr double begin_s = 2, end_s = 6.3, step_s = (end_s - begin_s) / steps;
  for (int i = 0; i < steps; ++i) {
    const auto pose = pose_at(track, begin_s + (i + 0.5) * step_s);
    REQUIRE(pose);
    way_m += glm::conjugate(pose->orientation) * pose->velocity_m_s * step_s;
    turn_rad += glm::conjugate(pose->orientation) * pose->angular_velocity_rad_s * step_s;
  }
  const Travelled now = travel.at(track, end_s);
  check_near(now.way_m, way_m, 1e-8);
  check_near(now.turn_rad, turn_rad, 1e-8);
  constexpr double h = 1e-5;
  for (const double time_s : {2.2, 3.1, 5.55, 7.2}) {
    const Travelled before = travel.at(track, time_s - h), at = travel.at(track, time_s);
    const Travelled after = travel.at(track, time_s + h);
    check_near((after.way_m - before.way_m) / (2 * h), at.velocity_m_s, 1e-7);
    check_near((after.turn_rad - before.turn_rad) / (2 * h), at.rate_rad_s, 1e-7);
  }
}

TEST_CASE("ways stand still in gaps, before the first sample and after the last one") {
  Track track = bends();
  track.segments = {0, 6};
  const Travel travel(track);
  const double leaves_s = track.samples[5].time_s, comes_s = track.samples[6].time_s;
  const Travelled left = travel.at(track, leaves_s), gap = travel.at(track, 0.5 * (leaves_s + comes_s));
  CHECK(gap.way_m == left.way_m);
  CHECK(gap.velocity_m_s == glm::dvec3(0));
  CHECK(travel.at(track, comes_s).way_m == left.way_m);
  CHECK(travel.at(track, 0).way_m == glm::dvec3(0));
  CHECK(travel.at(track, 1e3).way_m == travel.at(track, track.samples.back().time_s).way_m);
}
