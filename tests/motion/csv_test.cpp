// SPDX-License-Identifier: Apache-2.0
// CSV: columns in any order, optional columns, line ends and quotes, and the errors with file and line.
// Yaw is mathematical here and the position is the centre, unlike in FCD.
#include <cmath>

#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

Trajectories read(const std::string& content) { return read_text(content, {}, "drive.csv"); }

}  // namespace

TEST_CASE("every column, with its convention") {
  const Trajectories t = read("time,id,x,y,z,yaw,speed\n0.5,a,1,2,3,90,4\n");
  const Sample& s = t.tracks.at(0).samples.at(0);
  CHECK(t.tracks[0].id == "a");
  CHECK(s.time_s == 0.5);
  check_near(s.position_m, {1, 2, 3});
  CHECK(s.yaw_rad == doctest::Approx(pi / 2));
  check_near(s.velocity_m_s, {0, 4, 0});
  CHECK(t.types.at(0) == VehicleType{"passenger", 5, 1.8, 1.5});
  CHECK(t.warnings.empty());
}

TEST_CASE("columns in any order, others told; CRLF, byte order mark, blank lines, comments, blanks, quotes") {
  const Trajectories t = read(
      "\xEF\xBB\xBF\r\n# a drive\r\nY, colour ,X,\"type\",id,Time\r\n\r\n 2 ,red, 1 ,truck,\"van, \"\"old\"\"\",0\r\n"
      "2,red,2,truck,\"van, \"\"old\"\"\" ,1");
  REQUIRE(t.tracks.size() == 1);
  CHECK(t.tracks[0].id == "van, \"old\"");
  CHECK(t.types[0] == VehicleType{"truck", 7.1, 2.4, 2.4});
  REQUIRE(t.tracks[0].samples.size() == 2);
  check_near(t.tracks[0].samples[1].position_m, {2, 2, 0});
  check_near(t.tracks[0].samples[1].velocity_m_s, {1, 0, 0});
  CHECK(t.tracks[0].samples[1].yaw_rad == 0);
  REQUIRE(t.warnings.size() == 1);
  check_contains(t.warnings[0], "drive.csv:3: the columns 'colour' are not used");
}

TEST_CASE("rows by vehicle or by time give the same") {
  const std::string header = "time,id,x,y\n";
  const Trajectories by_time = read(header + "0,b,0,0\n0.1,a,0,5\n1,b,9,0\n1.1,a,9,5\n");
  const Trajectories by_vehicle = read(header + "0.1,a,0,5\n1.1,a,9,5\n0,b,0,0\n1,b,9,0\n");
  for (const Trajectories& t : {by_time, by_vehicle}) {
    REQUIRE(t.tracks.size() == 2);
    CHECK(t.tracks[0].id == "b");
    CHECK(t.tracks[1].id == "a");
    CHECK(t.tracks[1].segments.size() == 1);
    CHECK(t.step_s == doctest::Approx(1));
    CHECK(t.last_time_s == 1.1);
  }
}

TEST_CASE("cells of optional columns may be empty") {
  const Trajectories t = read("time,id,x,y,yaw,speed\n0,a,0,0,,\n1,a,0,3,,\n2,a,0,6,45,1\n");
  const auto& s = t.tracks.at(0).samples;
  CHECK(s[0].yaw_rad == doctest::Approx(pi / 2));
  CHECK(s[1].speed_m_s == doctest::Approx(3));
  CHECK(s[2].yaw_rad == doctest::Approx(pi / 4));
  CHECK(s[2].speed_m_s == 1);
}

TEST_CASE("reverse: a speed below zero, or motion against the yaw") {
  const Trajectories given = read("time,id,x,y,yaw,speed\n0,a,0,0,0,-2\n1,a,-2,0,0,-2\n");
  check_near(given.tracks.at(0).samples[0].velocity_m_s, {-2, 0, 0});
  const Trajectories told = read("time,id,x,y,z,yaw\n0,a,0,0,0,0\n1,a,-2,0,1,0\n");  // uphill, tail first
  const Sample& s = told.tracks.at(0).samples[0];
  CHECK(s.speed_m_s == doctest::Approx(-std::sqrt(5.0)));
  CHECK(s.pitch_rad == doctest::Approx(-std::atan(0.5)));
  check_near(s.velocity_m_s, {-2, 0, 1});
}

TEST_CASE("CSV errors name file, line and column") {
  const auto fails = [](const std::string& content, const char* message) {
    CAPTURE(message);
    CHECK_THROWS_WITH_AS(read(content), Contains(message), InputError);
  };
  const std::string header = "time,id,x,y,z\n";
  fails("time,id,x\n",
        "drive.csv:1: the header has no column 'y'; the first line must be a header with the columns time,id,x,y");
  fails("0,a,1,2\n", "drive.csv:1: the header has no column 'time'");
  fails("\n\ntime;id;x;y\n", "drive.csv:3: the header has no column 'time'");
  fails("time;id;x;y\n", "separated by commas, not by semicolons");
  fails("time,id,x,y,X\n", "drive.csv:1: the header has the column 'x' twice");
  fails("# nothing\n", "drive.csv: the file is empty");
  fails(header, "drive.csv: the file contains no vehicle");
  fails(header + "0,a,1,2\n", "drive.csv:2: the row has 4 cells, the header 5");
  fails(header + "0,a,1,2,3,4\n", "drive.csv:2: the row has 6 cells, the header 5");
  fails(header + "0,a,1,2,3\n\n1,a,nan,2,3\n", "drive.csv:4: column 3 (x): 'nan' is not a finite number");
  fails(header + "0,a,1,2,3\n1,a,1e308,2,3\n",
        "drive.csv:3: vehicle 'a': its position is 1e+308 m, and 1e+09 is the most");
  fails(header + "-1e300,a,1,2,3\n", "drive.csv:2: vehicle 'a': its time is -1e+300 s, and 1e+12 is the most");
  fails("time,id,x,y,speed\n0,a,1,2,3e8\n", "drive.csv:2: vehicle 'a': its speed is 3e+08 m/s, and 1e+08 is the most");
  fails(header + "0,a,1,2,\n", "drive.csv:2: column 5 (z): '' is not a finite number");
  fails(header + ",a,1,2,3\n", "drive.csv:2: column 1 (time): '' is not a finite number");
  fails(header + "0,,1,2,3\n", "drive.csv:2: column 2 (id) is empty");
  fails(header + "0,\"a,1,2,3\n", "drive.csv:2: column 2: the quotes are not closed");
  fails(header + "0,\"a\"b,1,2,3\n", "drive.csv:2: column 2: text after the quotes");
  fails(header + "1,a,1,2,3\n1,b,1,2,3\n1,a,1,2,3\n",
        "drive.csv:4: vehicle 'a' has a second sample at 1 s, the first one is in line 2");
  fails(header + "1,a,1,2,3\n0,a,1,2,3\n", "drive.csv:3: vehicle 'a': time goes backwards, from 1 s in line 2 to 0 s");
  fails(std::string(2 << 20, 'x'), "drive.csv:1: the line does not end");
  fails(std::string("\xFF\xFEt\0i\0", 6), "drive.csv: this is a text file in UTF-16; save it as UTF-8");
}

TEST_CASE("a row at SUMO's invalid value is of a vehicle off the network, which is absent then") {
  const Trajectories t =
      read("time,id,x,y\n0,a,0,0\n1,a,5,0\n2,a,-1073741824,-1073741824.00\n3,a,15,0\n4,a,20,0\n4,b,-1073741824,0\n");
  REQUIRE(t.tracks.size() == 1);
  CHECK(t.tracks[0].samples.size() == 4);
  CHECK(t.tracks[0].segments == std::vector<uint32_t>{0, 2});
  REQUIRE(t.warnings.size() == 2);
  check_contains(t.warnings[0], "2 samples have x or y = -1073741824, which SUMO writes for a vehicle off the network");
  check_contains(t.warnings[1], "gaps or teleports in 1 tracks ('a')");
}
