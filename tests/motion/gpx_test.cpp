// SPDX-License-Identifier: Apache-2.0
// GPX: files that gpxpy 1.6.2 and GPSBabel 1.8.0 wrote, times, omissions with their messages, and errors with their
// lines. The projection of these tests is 10^5 m per degree, the ground a slope along x.
#include "folders.hpp"
#include "motion/readers.hpp"

#include "motion/pose.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

TrajectoryOptions on_a_slope() {
  TrajectoryOptions options;
  options.from_degrees = [](const glm::dvec2& degrees) { return 1e5 * (degrees - glm::dvec2(11.575, 48.137)); };
  options.ground = [](const glm::dvec2& p) { return p.x > 1000 ? std::optional<double>() : 100 + 0.1 * p.x; };
  return options;
}

std::string gpx(const std::string& points) {
  return "<?xml version=\"1.0\"?>\n<gpx version=\"1.1\">\n<trk><name>a</name><trkseg>\n" + points +
         "</trkseg></trk></gpx>\n";
}

std::string point(double latitude, double longitude, const std::string& time) {
  return "<trkpt lat=\"" + std::to_string(latitude) + "\" lon=\"" + std::to_string(longitude) + "\"><time>" + time +
         "</time></trkpt>\n";
}

std::string problem(const std::string& content, const TrajectoryOptions& options = on_a_slope()) {
  try {
    read_text(content, options, "drive.gpx");
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

std::filesystem::path sample(const char* name) {
  return std::filesystem::path(test::source_folder() + "/tests/motion/files") / name;
}

}  // namespace

TEST_CASE("what gpxpy writes: seconds from the first point, the name, the ground, the pitch of the slope") {
  const Trajectories t = read_trajectories(sample("gpxpy.gpx"), on_a_slope());
  REQUIRE(t.tracks.size() == 1);
  CHECK(t.tracks[0].id == "test car");
  REQUIRE(t.tracks[0].samples.size() == 6);
  for (int k = 0; k < 6; ++k) {
    const Sample& s = t.tracks[0].samples[static_cast<size_t>(k)];
    CHECK(s.time_s == doctest::Approx(1.25 * k).epsilon(1e-9));
    check_near(s.position_m, {20 * k, 10 * k, 100 + 2 * k}, 1e-6);
    CHECK(s.pitch_rad == doctest::Approx(std::atan(2 / std::hypot(20, 10))).epsilon(1e-6));
    CHECK(s.yaw_rad == doctest::Approx(std::atan2(10, 20)).epsilon(1e-6));
  }
  REQUIRE(t.warnings.size() == 1);
  check_contains(t.warnings[0], "the elevations of 6 points are not used");
}

TEST_CASE("what GPSBabel writes, a track without a name") {
  const Trajectories t = read_trajectories(sample("gpsbabel.gpx"), on_a_slope());
  REQUIRE(t.tracks.size() == 1);
  CHECK(t.tracks[0].id == "track");
  REQUIRE(t.tracks[0].samples.size() == 3);
  check_near(t.tracks[0].samples[1].position_m, {30, 20, 103}, 1e-6);
  CHECK(t.step_s == 1);
}

TEST_CASE("times of XML Schema; seconds since 1970 as date -u -d ... +%s counts them") {
  CHECK(utc_time("1970-01-01T00:00:00Z") == UtcTime{0, 0});
  CHECK(utc_time("2026-11-24T10:00:00.25Z") == UtcTime{1795514400, 0.25});
  CHECK(utc_time("2024-02-29T23:59:59+01:30") == UtcTime{1709245799, 0});
  CHECK(utc_time("2024-02-29T23:59:59") == UtcTime{1709251199, 0});
  for (const char* bad : {"", "2026-11-24", "2026-13-01T00:00:00Z", "2025-02-29T00:00:00Z", "2026-11-24T24:00:00Z",
                          "2026-11-24T10:00:00.Z", "2026-11-24T10:00:00 Z", "2026-11-24T10:00:00+1", "x"}) {
    CAPTURE(std::string(bad));
    CHECK_FALSE(utc_time(bad));
  }
}

TEST_CASE("points of one time count once, tracks of one name are two vehicles, places without a ground are told") {
  const std::string track = "<trk><name>a</name><trkseg>" + point(48.137, 11.575, "2026-01-01T00:00:00Z") +
                            point(48.137, 11.575, "2026-01-01T00:00:00Z") +
                            point(48.137, 11.5852, "2026-01-01T00:00:30Z") + "</trkseg></trk>";
  const Trajectories t = read_text("<gpx>" + track + track + "</gpx>", on_a_slope(), "drive.gpx");
  REQUIRE(t.tracks.size() == 2);
  CHECK(t.tracks[0].id == "a");
  CHECK(t.tracks[1].id == "a 2");
  check_near(t.tracks[0].samples.at(1).position_m, {1020, 0, 100}, 1e-6);  // beyond the ground: its height stays
  REQUIRE(t.warnings.size() == 2);
  check_contains(t.warnings[0], "2 points have the time of the point before");
  check_contains(t.warnings[1], "2 samples are outside of the ground");
}

TEST_CASE("what cannot be read says where and what to do") {
  const std::string good = point(48.137, 11.575, "2026-01-01T00:00:00Z");
  check_contains(problem(gpx("<trkpt lat=\"48\" lon=\"11\"/>\n")), "drive.gpx:4: <trkpt> has no <time>");
  check_contains(problem(gpx("<trkpt lon=\"11\"/>\n")), "drive.gpx:4: <trkpt> has no attribute 'lat'");
  check_contains(problem(gpx("<trkpt lat=\"91\" lon=\"11\"/>\n")), "lat = '91' is not a number of degrees from -90");
  check_contains(problem(gpx(good + point(48, 11, "2025-01-01T00:00:00Z"))), "time goes backwards");
  check_contains(problem(gpx(point(48, 11, "noon"))), "<time> 'noon' is not a time such as");
  check_contains(problem("<gpx><rte><rtept lat=\"1\" lon=\"1\"/></rte></gpx>"), "the file has no <trkpt>");
  check_contains(problem("<gpx><trk><trkseg>"), "the file ends before </gpx>");
  check_contains(problem("<gpx><trk></gpx>"), "not well-formed XML");
  check_contains(problem(gpx(good), {}), "need a georeference.json beside the scene file");
  TrajectoryOptions moved = on_a_slope();
  moved.offset_m.x = 1;
  check_contains(problem(gpx(good), moved), "remove trajectories.offset_m");
}

TEST_CASE("CSV in degrees: lat and lon in the place of y and x, z above the ground") {
  const Trajectories t =
      read_text("time,id,Latitude,lon,z\n0,a,48.137,11.575,1\n1,a,48.137,11.5751,2\n", on_a_slope(), "drive.csv");
  check_near(t.tracks.at(0).samples.at(0).position_m, {0, 0, 101}, 1e-6);
  check_near(t.tracks.at(0).samples.at(1).position_m, {10, 0, 103}, 1e-6);
  const auto refused = [](const std::string& content) { return problem(content); };
  check_contains(refused("time,id,lat,x\n0,a,1,2\n"), "must have both lat and lon");
  check_contains(refused("time,id,lat,lon,x,y\n0,a,1,2,3,4\n"), "the header has the column 'x' twice");
  check_contains(refused("time,id,lat,lon\n0,a,95,2\n"), "drive.gpx:2: latitude 95 and longitude 2");
}

TEST_CASE("metres above the ground: a flat network on a hill, slopes of the file not used") {
  TrajectoryOptions options = on_a_slope();
  options.above_ground = true;
  const Trajectories t =
      read_text(fcd(timestep("0", "<vehicle id=\"a\" x=\"0\" y=\"0\" angle=\"90\" speed=\"10\" slope=\"0\"/>") +
                    timestep("1", "<vehicle id=\"a\" x=\"10\" y=\"0\" angle=\"90\" speed=\"10\" slope=\"0\"/>")),
                options);
  const Sample& s = t.tracks.at(0).samples.at(1);
  CHECK(s.pitch_rad == doctest::Approx(std::atan(0.1)));
  check_near(s.position_m, glm::dvec3(10, 0, 101) - 2.5 * glm::dvec3(std::cos(s.pitch_rad), 0, std::sin(s.pitch_rad)),
             1e-9);
}

TEST_CASE("waypoints above the ground: the vehicle stays on a ridge between them") {
  const GroundHeight ridge = [](const glm::dvec2& p) { return 10 - std::abs(p.x) / 10; };
  WaypointTrack track;
  track.id = "a";
  track.type = VehicleType{"passenger", 5, 1.8, 1.5};
  track.waypoints = {{0, {-50, 0, 0.5}}, {10, {50, 0, 0.5}}};
  track.above_ground = true;
  const Trajectories t = connect_waypoints(std::span(&track, 1), ridge);
  CHECK(t.step_s == 10);
  for (double time_s = 0; time_s <= 10; time_s += 0.37) {
    const glm::dvec3 p = pose_at(t.tracks.at(0), time_s)->position_m;
    CHECK(p.z == doctest::Approx(10.5 - std::abs(p.x) / 10).epsilon(0.02));
  }
}
