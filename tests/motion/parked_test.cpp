// SPDX-License-Identifier: Apache-2.0
// Files of parked vehicles: columns in any order, optional columns, and errors with file and line.
#include "motion/parked.hpp"
#include "folders.hpp"

#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

std::vector<ParkedPlace> parked(const std::string& content) {
  const TemporaryFolder folder;
  return read_parked(folder.write("parked.csv", content));
}

}  // namespace

TEST_CASE("places of parked vehicles, with all columns and with two") {
  const auto all = parked("# a kerb\nyaw,type,z,y,x\n90,truck,1,2,3\n,,,5,6\n");
  REQUIRE(all.size() == 2);
  check_near(all[0].position_m, {3, 2, 1});
  CHECK(all[0].yaw_deg == 90);
  CHECK(all[0].type == "truck");
  check_near(all[1].position_m, {6, 5, 0});
  CHECK(all[1].yaw_deg == 0);
  CHECK(all[1].type.empty());
  CHECK(parked("X,Y\n1,2").size() == 1);
}

TEST_CASE("what is wrong with such a file") {
  const auto check = [](const std::string& content, const char* text) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(parked(content), Contains(text), InputError);
  };
  check("", "the file is empty");
  check("x,y\n", "there is no row below the header");
  check("x\n1\n", "parked.csv:1: the header has no column 'y'");
  check("x,y,x\n", "the header has the column 'x' twice");
  check("x,y,speed\n", "there is no column 'speed'");
  check("x,y\n1\n", "parked.csv:2: the row has 1 cells, the header 2");
  check("x,y\n1,far\n", "parked.csv:2: y = 'far' is not a finite number");
  check("x,y\n1,\n", "y = '' is not a finite number");
}

TEST_CASE("vehicles that SUMO has parked stand where it puts them: on the lot, or on their lane") {
  const Trajectories t = read_trajectories(test::source_folder() + "/tests/motion/files/parked.fcd.xml");
  REQUIRE(t.tracks.size() == 2);
  for (const Track& track : t.tracks) {
    const Sample& last = track.samples.back();
    CAPTURE(track.id);
    CHECK(last.time_s == t.last_time_s);
    CHECK(last.speed_m_s == 0);
    if (track.id != "parker") continue;
    check_near(last.position_m, {46.666667, -3.2 - 2.5, 0}, 1e-6);  // its front bumper is at the lane
    CHECK(last.yaw_rad == doctest::Approx(pi / 2));
  }
}
