// SPDX-License-Identifier: Apache-2.0
// Files of esmini, by the formats of its sources (CSV_Logger of CommonMini.cpp, dat2csv.cpp; 2025): the log with
// entities that come and go, the recording with and without its first line, and errors.
#include "motion/readers.hpp"

#include <fmt/format.h>

#include <cmath>

#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

std::string block_header(int number, const char* name = "Entity_Name") {
  const std::string columns[] = {std::string(name) + " [-]",
                                 "Entity_ID [-]",
                                 "Current_Speed [m/s]",
                                 "Wheel_Angle [deg]",
                                 "Wheel_Rotation [-]",
                                 "bb_x [m]",
                                 "bb_y [m]",
                                 "bb_z [m]",
                                 "bb_length [m]",
                                 "bb_width [m]",
                                 "bb_height [m]",
                                 "World_Position_X [m]",
                                 "World_Position_Y [m]",
                                 "World_Position_Z [m]",
                                 "Vel_X [m/s]",
                                 "Vel_Y [m/s]",
                                 "Vel_Z [m/s]",
                                 "Acc_X [m/s2]",
                                 "Acc_Y [m/s2]",
                                 "Acc_Z [m/s2]",
                                 "Distance_Travelled_Along_Road_Segment [m]",
                                 "Lateral_Distance_Lanem [m]"};
  std::string out;
  for (const std::string& column : columns) out += fmt::format("#{} {} , ", number, column);
  out += fmt::format(
      "#{0} lane_id, #{0} lane_offset[m] , #{0} World_Heading_Angle [rad] , #{0} Heading_Angle_Rate [rad/s] , "
      "#{0} Relative_Heading_Angle [rad] , #{0} Relative_Heading_Angle_Drive_Direction [rad] , "
      "#{0} World_Pitch_Angle [rad] , #{0} Road_Curvature [1/m] , #{0} collision_ids , ",
      number);
  return out;
}

std::string header(int entities) {
  std::string out =
      "esmini GIT REV: v2.40.1-0-b5e5d1b\nesmini GIT TAG: v2.40.1\nesmini GIT BRANCH: tags/v2.40.1^0\n"
      "esmini BUILD VERSION: N/A - client build\nScenario File Name: ../resources/xosc/cut-in.xosc\n";
  out += fmt::format("Number of Vehicles: {}\nIndex [-] , TimeStamp [s] , ", entities);
  for (int k = 1; k <= entities; ++k) out += block_header(k);
  return out + "\n";
}

// A car whose box is 5 x 2 x 1.5 m, 1.4 m ahead of the rear axle.
std::string block(const std::string& name, double speed, double x, double y, double yaw, double pitch = 0) {
  return fmt::format(
      "{}, 0, {:f}, 0.000000, 0.000000, 1.400000, 0.000000, 0.750000, 5.000000, 2.000000, 1.500000, {:f}, {:f}, "
      "0.500000, "
      "0, 0, 0, 0, 0, 0, 0, 0, -1, 0, {:f}, 0, 0, 0, {:f}, 0, , ",
      name, speed, x, y, yaw, pitch);
}

}  // namespace

TEST_CASE("the log of esmini: entities by name, the middle of their boxes, sizes") {
  const std::string content = header(2) + "0, 0.000000, " + block("Ego", 10, 0, 0, 0) + block("Other", 5, 50, 3, pi) +
                              "\n1, 0.100000, " + block("Other", 5, 49.5, 3, pi) + "\n2, 0.200000, " +
                              block("Other", 5, 49, 3, pi) + block("New", 0, 7, 7, pi / 2, 0.1) + "\n";
  const Trajectories t = read_text(content, {}, "sim.csv");
  REQUIRE(t.tracks.size() == 3);
  CHECK(t.tracks[0].id == "Ego");
  CHECK(t.tracks[0].samples.size() == 1);
  CHECK(t.types.size() == 1);
  CHECK(t.types[0] == VehicleType{"passenger", 5, 2, 1.5});
  check_near(t.tracks[0].samples[0].position_m, {1.4, 0, 0.5}, 1e-9);
  check_near(t.tracks[0].samples[0].velocity_m_s, {10, 0, 0}, 1e-9);
  CHECK(t.tracks[1].id == "Other");
  REQUIRE(t.tracks[1].samples.size() == 3);
  check_near(t.tracks[1].samples[2].position_m, {47.6, 3, 0.5}, 1e-5);
  const Sample& tilted = t.tracks[2].samples[0];  // nose down
  CHECK(tilted.pitch_rad == doctest::Approx(-0.1));
  check_near(tilted.position_m, {7, 7 + 1.4 * std::cos(0.1), 0.5 - 1.4 * std::sin(0.1)}, 1e-5);
}

TEST_CASE("the log of an older esmini, whose header is misspelt") {
  const std::string content = "Index [-] , TimeStamp [s] , " + block_header(1, "Entitity_Name") + "\n0, 0.5, " +
                              block("Ego", 1, 2, 3, 0) + "\n";
  const Trajectories t = read_text(content, {}, "sim.csv");
  CHECK(t.tracks.at(0).id == "Ego");
  CHECK(t.first_time_s == 0.5);
}

TEST_CASE("a recording of esmini as text: the centre is ahead of the axle, and a warning says so") {
  const std::string columns = "time, id, name, x, y, z, h, p, r, speed, wheel_angle, wheel_rot\n";
  const std::string longer =
      "time, id, name, x, y, z, h, p, r, roadId, laneId, offset, t, s, speed, wheel_angle, wheel_rot\n";
  const std::string first = "Version: 4.3, OpenDRIVE: ../xodr/e6mini.xodr, 3DModel: e6mini.osgb, GIT REV: abc\n";
  const std::string rows =
      "0.000, 0, Ego, 10.000, 20.000, 0.000, 1.571, 0.000, 0.000, 8.000, 0.000, 0.000\n"
      "0.100, 0, Ego, 10.000, 20.800, 0.000, 1.571, 0.000, 0.000, 8.000, 0.000, 0.000\n";
  for (const std::string& content :
       {columns + rows, first + columns + rows,
        longer + "0.000, 0, Ego, 10.000, 20.000, 0.000, 1.571, 0.000, 0.000, 1, -1, 0, 0, 5, 8.000, 0.000, 0.000\n"}) {
    const Trajectories t = read_text(content, {}, "sim.csv");
    REQUIRE(t.tracks.size() == 1);
    check_near(t.tracks[0].samples[0].position_m, {10, 21.4, 0}, 1e-3);
    check_near(t.tracks[0].samples[0].velocity_m_s, {0, 8, 0}, 1e-2);
    REQUIRE(t.warnings.size() == 1);
    check_contains(t.warnings[0], "1.4 m ahead of the rear axle");
  }
}

TEST_CASE("a run of esmini in real time: steps vary, and a text of few digits repeats times") {
  std::string rows = header(1);
  for (const double time_s : {0.0, 0.001, 0.002, 0.003, 0.061, 0.062})
    rows += fmt::format("0, {:f}, ", time_s) + block("Ego", 10, 10 * time_s, 0, 0) + "\n";
  const Trajectories log = read_text(rows, {}, "sim.csv");
  CHECK(log.tracks.at(0).samples.size() == 6);
  CHECK(log.tracks[0].segments.size() == 1);
  CHECK(log.warnings.empty());

  const std::string columns = "time, id, name, x, y, z, h, p, r, speed, wheel_angle, wheel_rot\n";
  const auto row = [](const char* time, int id, double x) {
    return fmt::format("{}, {}, Ego, {:.3f}, 0, 0, 0, 0, 0, 10, 0, 0\n", time, id, x);
  };
  const std::string begin = columns + row("0.000", 0, 0) + row("0.001", 0, 0.01);
  const Trajectories t = read_text(begin + row("0.001", 0, 0.012) + row("0.058", 0, 0.58), {}, "sim.csv");
  CHECK(t.tracks.at(0).samples.size() == 3);
  CHECK(t.tracks[0].segments.size() == 1);
  check_near(t.tracks[0].samples[1].position_m, {1.41, 0, 0}, 1e-9);
  check_contains(t.warnings.at(0), "1 rows have the time of an earlier one of their entity");
  CHECK_THROWS_WITH_AS(read_text(begin + row("0.001", 1, 5), {}, "sim.csv"), Contains("ids must be unique"),
                       InputError);
}

TEST_CASE("what is wrong with a log or a recording is said with its line") {
  const auto check = [](const std::string& content, const char* text) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(read_text(content, {}, "sim.csv"), Contains(text), InputError);
  };
  check("esmini GIT REV: a\n", "has no line that begins with 'Index [-]'");
  check("Index [-] , TimeStamp [s] , #1 Entity_Name [-] , \n",
        "sim.csv:1: the header has no column '#1 Current_Speed'");
  check(header(1) + "0, x, " + block("Ego", 1, 2, 3, 0), "sim.csv:8: column 2 (TimeStamp): 'x' is not a finite number");
  check(header(1) + "0, 0, " + block("Ego", 1, 2, 3, std::nan("")),
        "(World_Heading_Angle): 'nan' is not a finite number");
  check(header(1) + "0, 0, \n", "the file contains no vehicle");
  check(header(1) + "0\n", "sim.csv:8: the row has 1 cells, and so no time");
  check("time, id, name, x, y, z, h, p, r\n", "the header has no column 'speed'");
  check("time, id, name, x, y, z, h, p, r, speed\n1, 0, a, 1\n", "sim.csv:2: the row has 4 cells, the header 10");
}
