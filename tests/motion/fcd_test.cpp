// SPDX-License-Identifier: Apache-2.0
// SUMO FCD: its conventions by hand-computed numbers, what it may leave out, gzip by content, and bounded memory.
// Files are written here as SUMO writes them.
#include <sys/resource.h>

#include <cmath>

#include "motion/pose.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

// One car in one timestep, of SUMO's default size: 5 m long.
Sample one(const std::string& attributes, const TrajectoryOptions& options = {}) {
  return read_text(fcd(timestep("0.00", "<vehicle id=\"a\" " + attributes + "/>")), options).tracks.at(0).samples.at(0);
}

}  // namespace

TEST_CASE("angle is compass degrees, the position is the front bumper") {
  struct Case {
    const char* angle;
    double yaw_rad;
    glm::dvec3 centre, velocity;
  };
  const double half = std::sqrt(0.5);
  const Case cases[] = {{"0.00", pi / 2, {100, 47.5, 0}, {0, 10, 0}},  // north
                        {"90.00", 0, {97.5, 50, 0}, {10, 0, 0}},       // east
                        {"180.00", -pi / 2, {100, 52.5, 0}, {0, -10, 0}},
                        {"270.00", -pi, {102.5, 50, 0}, {-10, 0, 0}},
                        {"45.00", pi / 4, {100 - 2.5 * half, 50 - 2.5 * half, 0}, {10 * half, 10 * half, 0}},
                        {"360.00", pi / 2, {100, 47.5, 0}, {0, 10, 0}}};
  for (const Case& c : cases) {
    CAPTURE(c.angle);
    const Sample s =
        one(std::string("x=\"100.00\" y=\"50.00\" speed=\"10.00\" type=\"passenger\" angle=\"") + c.angle + "\"");
    CHECK(std::abs(std::remainder(s.yaw_rad - c.yaw_rad, 2 * pi)) < 1e-14);
    check_near(s.position_m, c.centre);
    check_near(s.velocity_m_s, c.velocity);
    CHECK(s.speed_m_s == 10);
  }
}

TEST_CASE("slope lifts the nose: 30 degrees") {
  const Sample s = one("x=\"0\" y=\"0\" z=\"7\" angle=\"90\" slope=\"30\" speed=\"2\" type=\"passenger\"");
  CHECK(s.pitch_rad == doctest::Approx(pi / 6).epsilon(1e-14));
  check_near(s.position_m, {-2.5 * std::sqrt(0.75), 0, 7 - 1.25});
  check_near(s.velocity_m_s, {std::sqrt(3.0), 0, 1});
}

TEST_CASE("a turning car: every centre lies behind its bumper") {
  // North, then east around a corner at the origin.
  const Trajectories t =
      read_text(fcd(timestep("0", "<vehicle id=\"a\" x=\"0\" y=\"-10\" angle=\"0\" speed=\"10\"/>") +
                    timestep("1", "<vehicle id=\"a\" x=\"0\" y=\"0\" angle=\"45\" speed=\"10\"/>") +
                    timestep("2", "<vehicle id=\"a\" x=\"10\" y=\"0\" angle=\"90\" speed=\"10\"/>")));
  const auto& samples = t.tracks.at(0).samples;
  check_near(samples[0].position_m, {0, -12.5, 0});
  check_near(samples[1].position_m, {-2.5 * std::sqrt(0.5), -2.5 * std::sqrt(0.5), 0});
  check_near(samples[2].position_m, {7.5, 0, 0});
  // A quarter turn to the right in two seconds, evenly: the rate is that of both steps.
  check_near(pose_at(t.tracks[0], 1.0)->angular_velocity_rad_s, {0, 0, -pi / 4});
  check_near(pose_at(t.tracks[0], 0.25)->angular_velocity_rad_s, {0, 0, -pi / 4});
}

TEST_CASE("lengths come from the type") {
  const std::string rest = "x=\"0\" y=\"0\" angle=\"90\" type=";
  check_near(one(rest + "\"truck\"").position_m, {-3.55, 0, 0});
  check_near(one(rest + "\"bus\"").position_m, {-6, 0, 0});
  TrajectoryOptions options;
  options.types = {{"bus", 18, 2.5, 3.2}};
  check_near(one(rest + "\"bus\"", options).position_m, {-9, 0, 0});
  check_near(one(rest + "\"bus@b7\"", options).position_m, {-9, 0, 0});  // changed at run time
  check_near(one("x=\"0\" y=\"0\" angle=\"90\"").position_m, {-2.5, 0, 0});
}

TEST_CASE("coordinates of the file to those of the scene; sizes and speeds stay") {
  TrajectoryOptions options;
  options.offset_m = {-500, 20, 1};
  options.scale = 2;
  const Sample s = one("x=\"100\" y=\"50\" angle=\"90\" speed=\"3\"", options);
  check_near(s.position_m, {200 - 500 - 2.5, 100 + 20, 1});
  check_near(s.velocity_m_s, {3, 0, 0});
}

TEST_CASE("attributes that SUMO was told to leave out follow from the motion") {
  // Uphill to the north-east, 3-4-5 in the plane and 1 m up per second; then it stands.
  std::string steps;
  for (int k = 0; k < 4; ++k) {
    const int way = std::min(k, 2);
    steps += timestep(std::to_string(k), "<vehicle id=\"a\" x=\"" + std::to_string(3 * way) + "\" y=\"" +
                                             std::to_string(4 * way) + "\" z=\"" + std::to_string(way) + "\"/>");
  }
  const Trajectories t = read_text(fcd(steps));
  CHECK(t.warnings.empty());
  const auto& s = t.tracks.at(0).samples;
  const glm::dvec3 ahead = glm::dvec3(3, 4, 1) / std::sqrt(26.0);
  for (int k = 0; k < 4; ++k) {
    CAPTURE(k);
    CHECK(s[k].yaw_rad == doctest::Approx(std::atan2(4, 3)));
    CHECK(s[k].pitch_rad == doctest::Approx(std::atan2(1, 5)));
    check_near(s[k].position_m, glm::dvec3(3, 4, 1) * double(std::min(k, 2)) - 2.5 * ahead);
    check_near(s[k].velocity_m_s, k < 2 ? glm::dvec3(3, 4, 1) : glm::dvec3(0));
    CHECK(s[k].speed_m_s == doctest::Approx(k < 2 ? std::sqrt(26.0) : 0));
  }
}

TEST_CASE("a vehicle that never moves and has no angle looks along +x, and says so") {
  const Trajectories t = read_text(fcd(timestep("0", "<vehicle id=\"parked\" x=\"1\" y=\"2\"/>")));
  CHECK(t.tracks.at(0).samples[0].yaw_rad == 0);
  REQUIRE(t.warnings.size() == 1);
  check_contains(t.warnings[0], "the heading of 'parked' is not given, and they do not move");
}

TEST_CASE("SUMO's default of two decimals is told, since it spoils phases") {
  const auto warnings = [](const std::string& x) {
    return read_text(fcd(timestep("0", "<vehicle id=\"a\" x=\"" + x + "\" y=\"2.00\" angle=\"0\"/>"))).warnings;
  };
  REQUIRE(warnings("1.00").size() == 1);
  check_contains(warnings("1.00")[0], "positions have 2 decimals");
  CHECK(warnings("1.000000").empty());
}

TEST_CASE("times in hours, minutes and seconds") {
  const auto first = [](const std::string& time) {
    return read_text(fcd(timestep(time, "<vehicle id=\"a\" x=\"0\" y=\"0\" angle=\"0\"/>"))).first_time_s;
  };
  CHECK(first("00:00:01") == 1);
  CHECK(first("01:02:03.25") == 3723.25);
  CHECK(first("30:00:00") == 108000);
  CHECK(first("2:03:00:00") == 2 * 86400 + 3 * 3600);
  CHECK(first("-00:00:10") == -10);
  CHECK(first("12.50") == 12.5);
}

TEST_CASE("persons, containers and riders") {
  const std::string text =
      fcd(timestep("0",
                   "<vehicle id=\"0\" x=\"0\" y=\"0\" angle=\"90\" type=\"bus\"><person id=\"r\" x=\"0\" y=\"0\" "
                   "angle=\"90\"/><container id=\"c\" x=\"0\" y=\"0\"/></vehicle>"
                   "<person id=\"0\" x=\"5\" y=\"5\" angle=\"90\" speed=\"1.2\" type=\"DEFAULT_PEDTYPE\" edge=\"e\"/>"
                   "<container id=\"0\" x=\"9\" y=\"9\" angle=\"90\"/><signal/><signal/>"));
  const Trajectories cars = read_text(text);
  REQUIRE(cars.tracks.size() == 1);
  REQUIRE(cars.warnings.size() == 3);
  check_contains(cars.warnings[0], "drive.xml:3: <signal> is unknown and was skipped");
  check_contains(cars.warnings[1], "2 samples of persons and containers were left out");
  check_contains(cars.warnings[2], "2 samples of riders were left out");
  TrajectoryOptions options;
  options.persons = options.containers = true;
  const Trajectories all = read_text(text, options);
  REQUIRE(all.tracks.size() == 3);
  CHECK(all.tracks[0].id == "0");
  CHECK(all.tracks[1].id == "container:0");
  CHECK(all.tracks[2].id == "person:0");
  CHECK(all.types[all.tracks[2].type] == VehicleType{"DEFAULT_PEDTYPE", 0.215, 0.478, 1.719});
  CHECK(all.types[all.tracks[1].type] == VehicleType{"DEFAULT_CONTAINERTYPE", 6.1, 2.4, 2.6});
  check_near(all.tracks[2].samples[0].position_m, {5 - 0.1075, 5, 0});
}

TEST_CASE("tracks come by first appearance, then id, and types are shared") {
  const auto car = [](const std::string& id, const std::string& type) {
    return "<vehicle id=\"" + id + "\" x=\"0\" y=\"0\" angle=\"0\" speed=\"0\" type=\"" + type +
           "\" lane=\"e_0\" pos=\"1\"/>";
  };
  const Trajectories t = read_text(fcd(timestep("0", "") + timestep("1", car("z", "car") + car("b", "spaceship")) +
                                       timestep("2", car("b", "car") + car("a", "car")) + timestep("3", "")));
  REQUIRE(t.tracks.size() == 3);
  CHECK(t.tracks[0].id == "b");
  CHECK(t.tracks[1].id == "z");
  CHECK(t.tracks[2].id == "a");
  REQUIRE(t.types.size() == 2);
  CHECK(t.types[0].name == "car");
  CHECK(t.types[1] == VehicleType{"spaceship", 5, 1.8, 1.5});
  CHECK(t.tracks[0].type == 1);
  CHECK(t.tracks[2].type == 0);
  CHECK(t.first_time_s == 1);
  CHECK(t.last_time_s == 2);
  CHECK(t.step_s == 1);
  REQUIRE(t.warnings.size() == 2);
  check_contains(t.warnings[0], "the sizes of the vehicle types 'spaceship' are unknown: 5 x 1.8 x 1.5 m is used");
  check_contains(t.warnings[1], "1 samples change the type of their vehicle");
}

TEST_CASE("the content decides: gzip, XML and CSV under any name") {
  const std::string xml = fcd(timestep("0", "<vehicle id=\"\xC3\xA4\" x=\"1\" y=\"2\" angle=\"90\"/>"));
  for (const char* name : {"a.xml", "a.xml.gz", "a.csv", "a"}) {
    CAPTURE(name);
    for (const std::string& content : {xml, gzip(xml), "\xEF\xBB\xBF" + xml, " \n" + xml.substr(xml.find("<fcd"))}) {
      const Trajectories t = read_text(content, {}, name);
      CHECK(t.tracks.at(0).id == "\xC3\xA4");
      check_near(t.tracks[0].samples[0].position_m, {-1.5, 2, 0});
    }
    const std::string csv = "time,id,x,y,yaw\n0,\xC3\xA4,1,2,0\n";
    for (const std::string& content : {csv, gzip(csv)}) {
      check_near(read_text(content, {}, name).tracks.at(0).samples.at(0).position_m, {1, 2, 0});
    }
  }
}

TEST_CASE("a file of 50 MB is read in bounded memory") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "long.xml.gz";
  uint64_t bytes = 0;
  {
    const gzFile out = gzopen(path.c_str(), "wb1");
    const auto put = [&](const std::string& text) {
      REQUIRE(gzwrite(out, text.data(), static_cast<unsigned>(text.size())) == static_cast<int>(text.size()));
      bytes += text.size();
    };
    std::string crowd;  // read, but not kept
    for (int i = 0; i < 2000; ++i) {
      crowd += "<person id=\"" + std::to_string(i) + "\" x=\"1000.00\" y=\"2000.00\" angle=\"1.00\" speed=\"1.00\"/>\n";
    }
    put("<fcd-export>\n");
    for (int k = 0; bytes < 50'000'000; ++k) {
      put(timestep(std::to_string(k),
                   crowd + "<vehicle id=\"a\" x=\"" + std::to_string(k) + "\" y=\"0\" angle=\"90\"/>"));
    }
    put("</fcd-export>\n");
    REQUIRE(gzclose(out) == Z_OK);
  }
  const auto peak_kib = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const long before = peak_kib();
  const Trajectories t = read_trajectories(path);
  const long grown = peak_kib() - before;
  CHECK(t.tracks.at(0).samples.size() > 300);
#ifndef __SANITIZE_ADDRESS__  // the sanitizer keeps freed memory
  CHECK(grown < 8 * 1024);
#else
  MESSAGE("peak memory grew by ", grown, " KiB");
#endif
}
