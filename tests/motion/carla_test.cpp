// SPDX-License-Identifier: Apache-2.0
// Recordings of CARLA as text, by the format of its sources (CarlaRecorderQuery.cpp of 0.9.15): centimetres, y to the
// right, boxes anywhere; skipped lines, and errors.
#include "motion/readers.hpp"

#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

const std::string head = "Version: 1\nMap: Carla/Maps/Town05\nDate: 02/21/19 10:46:20\n\n";
const std::string created =
    "Frame 1 at 0 seconds\n Create 2190: spectator (0) at (-260, -200, 382.001)\n"
    " Create 2191: traffic.traffic_light (3) at (4255, 10020, 0)\n"
    " Create 3137: vehicle.jeep.wrangler_rubicon (1) at (-5236.45, 8543.61, 1.8)\n  number_of_wheels = 4\n"
    "  base_type = car\n  role_name = hero\n  color = 255,255,255\n"
    " Create 3138: vehicle.harley-davidson.low_rider (1) at (0, 0, 0)\n  number_of_wheels = 2\n"
    "  role_name = autopilot\n"
    " Create 3139: walker.pedestrian.0001 (2) at (0, 0, 93)\n"
    " Parenting 3140 with 3137 (parent)\n";
const std::string boxes =
    " Actor bounding boxes: 2\n  Id: 3137 origin: (10, 20, 80) extension: (193, 95, 92)\n"
    "  Id: 3139 origin: (0, 0, 0) extension: (18.75, 18.75, 93)\n";

}  // namespace

TEST_CASE("a recording of CARLA: metres, y to the left, boxes, classes, the hero by name") {
  const std::string content =
      head + created +
      " Positions: 5\n  Id: 2190 Location: (-260, -200, 382) Rotation: (0, 0, 0)\n"
      "  Id: 3137 Location: (1000, 500, 10) Rotation: (0, 0, 90)\n"
      "  Id: 3138 Location: (0, -300, 0) Rotation: (0, 0, 180)\n"
      "  Id: 3139 Location: (100, 200, 93) Rotation: (0, 0, 0)\n"
      " State traffic lights: 1\n  Id: 2191 state: 1 frozen: 0 elapsedTime: 3.5\n"
      " Vehicle animations: 1\n  Id: 3137 Steering: 0 Throttle: 0.5 Brake: 0 Handbrake: 0 Gear: 1\n" +
      boxes +
      "Frame 2 at 0.05 seconds\n Positions: 1\n  Id: 3137 Location: (1000, 550, 10) Rotation: (0, 0, 90)\n"
      " Destroy 3138\n\nFrames: 2\nDuration: 0.05 seconds\n";
  const Trajectories t = read_text(content, {}, "rec.txt");
  REQUIRE(t.tracks.size() == 3);
  const Track* hero = nullptr;
  for (const Track& track : t.tracks) {
    const VehicleType& type = t.types[track.type];
    if (track.id == "hero") {
      hero = &track;
      CHECK(type.name == "car");
      check_near({type.length_m, type.width_m, type.height_m}, {3.86, 1.9, 1.84});
    } else if (track.id == "3138") {
      CHECK(type.name == "motorcycle");
      check_near(track.samples[0].position_m, {0, 3, 0});
      CHECK(std::abs(track.samples[0].yaw_rad) == doctest::Approx(pi));
    } else {
      CHECK(track.id == "3139");
      CHECK(type.name == "pedestrian");
      check_near({type.length_m, type.width_m, type.height_m}, {0.375, 0.375, 1.86});
      check_near(track.samples[0].position_m, {1, -2, 0});
    }
  }
  REQUIRE(hero);
  REQUIRE(hero->samples.size() == 2);
  // It looks along -y here; its box is 0.1 m ahead of and 0.2 m to the right of its location, which is -x.
  check_near(hero->samples[0].position_m, {10 - 0.2, -5 - 0.1, 0.1 + 0.8 - 0.92}, 1e-9);
  check_near(hero->samples[1].velocity_m_s, {0, -10, 0}, 1e-9);
  REQUIRE(t.warnings.size() == 1);
  check_contains(t.warnings[0], "1 samples are of actors without a bounding box");
}

TEST_CASE("what is wrong with a recording of CARLA is said with its line, and what to do") {
  const auto check = [](const std::string& content, const char* text) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(read_text(content, {}, "rec.txt"), Contains(text), InputError);
  };
  check(head + created, "call show_recorder_file_info with show_all=True");
  const std::string at = "  Id: 3137 Location: (0, 0, 0) Rotation: (0, 0, 0)\n";
  check(head + created + at + "Frame 2 at 0 seconds\n" + at, "rec.txt:19: time does not go on");
  check(head + created + "  Id: 3137 Location: (0, x, 0) Rotation: (0, 0, 0)\n", "' x' is not a finite number");
  check(head + created + "  Id: 3137 Location: (0, 1, 0) Turned\n",
        "' Rotation: ' is expected where the line has ' Turned'");
  check(head + "Frame 1 at soon seconds\n", "rec.txt:5: 'soon' is not a finite number");
  check(head + " Create -1: vehicle.a (1) at (0, 0, 0)\n", "is not the number of an actor");
}
