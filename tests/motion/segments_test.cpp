// SPDX-License-Identifier: Apache-2.0
// Appearing, vanishing, gaps and jumps: where a vehicle is absent, and the messages about it.
// The bounds are those of read.hpp: 1.5 steps; 1.5 v t + 5 m + 5 m/s^2 t^2.
#include "motion/pose.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

// A CSV row of a vehicle along x.
std::string row(const std::string& id, double time_s, double x, double speed) {
  return std::to_string(time_s) + "," + id + "," + std::to_string(x) + ",0,0," + std::to_string(speed) + "\n";
}
const std::string header = "time,id,x,y,yaw,speed\n";

}  // namespace

TEST_CASE("absent before it appears and after it vanishes, with a microsecond's grace") {
  const Track track = read_text(header + row("a", 1, 0, 10) + row("a", 2, 10, 10)).tracks.at(0);
  CHECK_FALSE(pose_at(track, 0.99));
  CHECK_FALSE(pose_at(track, 2.01));
  CHECK(pose_at(track, 1 - 0.9e-6)->position_m == track.samples[0].position_m);
  CHECK(pose_at(track, 2 + 0.9e-6)->position_m == track.samples[1].position_m);
  CHECK_FALSE(pose_at(track, 2 + 1.1e-6));
  CHECK_FALSE(pose_at(track, not_given));
}

TEST_CASE("a gap in time splits a track") {
  std::string rows = header;
  for (int k : {0, 1, 2, 3, 7, 8, 9, 10}) rows += row("a", k, 10 * k, 10);
  const Trajectories t = read_text(rows);
  const Track& track = t.tracks.at(0);
  CHECK(track.segments == std::vector<uint32_t>{0, 4});
  for (double time_s : {3.1, 5.0, 6.9}) CHECK_FALSE(pose_at(track, time_s));
  for (double time_s : {3.0, 7.0, 7.1}) CHECK(pose_at(track, time_s));
  check_near(pose_at(track, 7.5)->velocity_m_s, {10, 0, 0});
  REQUIRE(t.warnings.size() == 1);
  check_contains(t.warnings[0], "gaps or teleports in 1 tracks ('a'), the first one after 3 s");
}

TEST_CASE("a jump farther than speed allows splits a track, at the bound and not below") {
  const auto segments = [](double distance) {
    return read_text(header + row("a", 0, 0, 10) + row("a", 1, distance, 10)).tracks.at(0).segments.size();
  };
  CHECK(segments(24.9) == 1);  // 1.5 * 10 + 5 + 5
  CHECK(segments(25.1) == 2);
  CHECK(segments(-25.1) == 2);
  const std::string lane_change =
      "time,id,x,y,yaw,speed\n0,a,0,0,0,10\n0.1,a,1,3.2,0,10\n0.2,a,2,3.2,0,10\n";  // SUMO, without the sublane model
  CHECK(read_text(lane_change).tracks.at(0).segments.size() == 1);
  const auto without_speed = [](const std::string& x) {
    return read_text("time,id,x,y\n0,a,0,0\n1,a," + x + ",0\n").tracks.at(0).segments.size();
  };
  CHECK(without_speed("109") == 1);  // 100 m/s, by default
  CHECK(without_speed("111") == 2);
}

TEST_CASE("headings and velocities do not reach across a teleport") {
  const Trajectories t = read_text("time,id,x,y\n0,a,0,0\n1,a,10,0\n2,a,5000,5000\n3,a,5000,5010\n");
  const Track& track = t.tracks.at(0);
  CHECK(track.segments == std::vector<uint32_t>{0, 2});
  check_near(track.samples[1].velocity_m_s, {10, 0, 0});
  check_near(track.samples[2].velocity_m_s, {0, 10, 0});
  CHECK(track.samples[1].yaw_rad == 0);
  CHECK(track.samples[2].yaw_rad == doctest::Approx(pi / 2));
  check_near(pose_at(track, 1)->angular_velocity_rad_s, {0, 0, 0});
}

TEST_CASE("a vehicle that is sampled more slowly than the others is not cut") {
  std::string rows = header;
  for (int k = 0; k < 40; ++k) rows += row("fast", 0.1 * k, k, 10);
  for (int k = 0; k < 4; ++k) rows += row("slow", k, 10 * k, 10);
  const Trajectories t = read_text(rows);
  CHECK(t.step_s == doctest::Approx(0.1));
  for (const Track& track : t.tracks) CHECK(track.segments.size() == 1);
}

TEST_CASE("a vehicle that leaves SUMO and comes back") {
  const std::string at[] = {"0", "10", "500"};
  std::string steps;
  for (int k = 0; k < 12; ++k) {
    std::string cars = "<vehicle id=\"other\" x=\"9\" y=\"9\" angle=\"0\" speed=\"0\"/>";
    if (k < 2 || k == 11) {
      cars += "<vehicle id=\"a\" x=\"" + at[std::min(k, 2)] + "\" y=\"0\" angle=\"90\" speed=\"10\"/>";
    }
    steps += timestep(std::to_string(k), cars);
  }
  const Trajectories t = read_text(fcd(steps));
  REQUIRE(t.tracks.at(0).id == "a");
  CHECK(t.tracks[0].segments == std::vector<uint32_t>{0, 2});
  CHECK(pose_at(t.tracks[0], 0.5));
  CHECK_FALSE(pose_at(t.tracks[0], 10.5));
  check_near(pose_at(t.tracks[0], 11)->position_m, {497.5, 0, 0});
}
