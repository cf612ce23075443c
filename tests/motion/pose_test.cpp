// SPDX-License-Identifier: Apache-2.0
// Poses between samples: the samples' own at their times, continuous, and with rates that are their derivatives.
// Derivatives are checked by central differences, orientations by turning vectors.
#include "motion/pose.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "motion/track_motion.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A drive of uneven steps with every kind of change, yaw through +-pi among them.
Track wild_track() {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  Track track{"a", 0, {}, {0}};
  double time_s = 0, yaw = 3;
  glm::dvec3 p(400, -300, 10);
  for (int k = 0; k < 60; ++k) {
    const double speed = 20 * unit(random), pitch = 0.4 * (unit(random) - 0.5);
    track.samples.push_back(sample_at(time_s, p, std::remainder(yaw, 2 * pi), pitch, speed));
    const double step_s = 0.2 + unit(random);
    time_s += step_s;
    p += step_s * (speed + 2 * unit(random)) * heading(yaw, pitch);
    yaw += 1.5 * (unit(random) - 0.4);
  }
  return track;
}

// A drive along a circle to the left, sampled every step_s from 0 on.
Track circle(double radius_m, double speed_m_s, double step_s, int count) {
  Track track{"a", 0, {}, {0}};
  for (int k = 0; k < count; ++k) {
    const double angle = speed_m_s * step_s * k / radius_m;
    track.samples.push_back(sample_at(step_s * k, radius_m * glm::dvec3(std::cos(angle), std::sin(angle), 0),
                                      std::remainder(angle + pi / 2, 2 * pi), 0, speed_m_s));
  }
  return track;
}

}  // namespace

TEST_CASE("at the time of a sample the pose is the sample's, to the last bit") {
  const Track track = wild_track();
  for (const Sample& s : track.samples) {
    const auto pose = pose_at(track, s.time_s);
    REQUIRE(pose);
    CHECK(pose->position_m == s.position_m);
    CHECK(pose->velocity_m_s == s.velocity_m_s);
    check_near(pose->orientation * glm::dvec3(1, 0, 0), heading(s.yaw_rad, s.pitch_rad), 1e-15);
    check_near(pose->orientation * glm::dvec3(0, 1, 0), {-std::sin(s.yaw_rad), std::cos(s.yaw_rad), 0}, 1e-15);
    CHECK((pose->orientation * glm::dvec3(0, 0, 1)).z > 0);  // upright
    CHECK(glm::length(pose->orientation) == doctest::Approx(1).epsilon(1e-15));
  }
}

TEST_CASE("position, velocity, orientation and angular velocity are continuous across samples") {
  const Track track = wild_track();
  for (size_t k = 1; k + 1 < track.samples.size(); ++k) {
    CAPTURE(k);
    const double time_s = track.samples[k].time_s, e = 1e-9;
    const auto before = pose_at(track, time_s - e), at = pose_at(track, time_s), after = pose_at(track, time_s + e);
    check_near(before->position_m, at->position_m, 1e-7);
    check_near(after->position_m, at->position_m, 1e-7);
    check_near(before->velocity_m_s, at->velocity_m_s, 1e-6);
    check_near(after->velocity_m_s, at->velocity_m_s, 1e-6);
    check_near(before->angular_velocity_rad_s, at->angular_velocity_rad_s, 1e-6);
    check_near(after->angular_velocity_rad_s, at->angular_velocity_rad_s, 1e-6);
    for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)}) {
      check_near(before->orientation * axis, after->orientation * axis, 1e-7);
    }
  }
}

TEST_CASE("velocity and angular velocity are the derivatives: central differences to 1e-6") {
  const Track track = wild_track();
  const double e = 1e-5;
  const glm::dvec3 antenna(-1.2, 0.4, 1.6);  // a point of the vehicle moves with both
  for (size_t k = 0; k + 1 < track.samples.size(); ++k) {
    for (double u : {0.01, 0.2, 0.5, 0.77, 0.99}) {
      const double time_s = (1 - u) * track.samples[k].time_s + u * track.samples[k + 1].time_s;
      CAPTURE(time_s);
      const auto before = pose_at(track, time_s - e), at = pose_at(track, time_s), after = pose_at(track, time_s + e);
      const glm::dvec3 v = (after->position_m - before->position_m) / (2 * e);
      CHECK(glm::distance(v, at->velocity_m_s) <= 1e-6 * std::max(1.0, glm::length(at->velocity_m_s)));
      const glm::dvec3 arm = at->orientation * antenna;
      const glm::dvec3 swing = (after->orientation * antenna - before->orientation * antenna) / (2 * e);
      CHECK(glm::distance(swing, glm::cross(at->angular_velocity_rad_s, arm)) <=
            1e-6 * std::max(1.0, glm::length(swing)));
    }
  }
}

TEST_CASE("a circle: 10 degrees a step, within R angle^4 / 384") {
  // The error of a cubic with exact ends is h^4 / 384 times the fourth derivative, here R w^4.
  const double radius = 20, speed = 10, angle = pi / 18;
  const double step_s = angle * radius / speed;
  const Track track = circle(radius, speed, step_s, 73);          // twice around, so that yaw wraps
  const double bound = 1.01 * radius * std::pow(angle, 4) / 384;  // 0.05 mm
  for (double time_s = 0; time_s <= 72 * step_s; time_s += step_s / 7) {
    const auto pose = pose_at(track, time_s);
    const double phi = time_s * speed / radius;
    CHECK(glm::distance(pose->position_m, radius * glm::dvec3(std::cos(phi), std::sin(phi), 0)) <= bound);
    CHECK(std::abs(glm::length(pose->velocity_m_s) - speed) <= 1e-4 * speed);
    check_near(pose->angular_velocity_rad_s, {0, 0, speed / radius}, 1e-12);  // an even turn stays even
    check_near(pose->orientation * glm::dvec3(1, 0, 0), {-std::sin(phi), std::cos(phi), 0}, 1e-12);
  }
}

TEST_CASE("yaw takes the shorter way and never overshoots") {
  Track track{"a", 0, {}, {0}};
  const double degree = pi / 180;
  for (int k = 0; k < 6; ++k) {
    const double yaw_deg[] = {170, 170, -170, -170, 100, 100};
    track.samples.push_back(sample_at(k, {k, 0, 0}, yaw_deg[k] * degree, 0, 0));
  }
  const auto yaw_deg = [&](double time_s) {  // from 0 to 360
    const glm::dvec3 ahead = pose_at(track, time_s)->orientation * glm::dvec3(1, 0, 0);
    return std::fmod(std::atan2(ahead.y, ahead.x) / degree + 360, 360);
  };
  for (double time_s = 0; time_s <= 5; time_s += 0.05) {
    CAPTURE(time_s);
    CHECK(yaw_deg(time_s) >= (time_s <= 3 ? 170 : 100) - 1e-9);
    CHECK(yaw_deg(time_s) <= 190 + 1e-9);
  }
  CHECK(yaw_deg(1.5) == doctest::Approx(180));
  CHECK(yaw_deg(0.5) == doctest::Approx(170));
}

TEST_CASE("the rate of yaw between uneven steps, by hand") {
  // 0.1 rad/s for 1 s, then 0.4 rad/s for 2 s: w = (1 + 2 * 2) / (3 * 3), and 0.1 * 0.4 / (w * 0.4 + (1 - w) * 0.1).
  Track track{"a", 0, {sample_at(0, {}, 0, 0, 0), sample_at(1, {}, 0.1, 0, 0), sample_at(3, {}, 0.9, 0, 0)}, {0}};
  check_near(pose_at(track, 0)->angular_velocity_rad_s, {0, 0, 0.1});
  check_near(pose_at(track, 1)->angular_velocity_rad_s, {0, 0, 0.15});
  check_near(pose_at(track, 3)->angular_velocity_rad_s, {0, 0, 0.4});
}

TEST_CASE("pitch turns about the vehicle's left: uphill is nose up") {
  Track track{"a", 0, {sample_at(0, {0, 0, 0}, pi / 2, 0, 1), sample_at(1, {0, 1, 0}, pi / 2, 0.2, 1)}, {0}};
  const auto pose = pose_at(track, 0.5);
  check_near(pose->orientation * glm::dvec3(1, 0, 0), {0, std::cos(0.1), std::sin(0.1)});
  check_near(pose->angular_velocity_rad_s, {0.2, 0, 0});  // left of north is -x: nose up is a turn about +x
}
