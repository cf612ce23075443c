// SPDX-License-Identifier: Apache-2.0
// Azimuths and elevations against the places of ends and of mirrors.
#include <cmath>

#include "radar/one_radar.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// The first detection of a receiver that looks along +x and sees the transmitter in this direction.
RadarDetections seen_at(const ArrayConfig& array, double azimuth, double elevation) {
  const glm::dvec3 to{15 * std::cos(elevation) * std::cos(azimuth), 15 * std::cos(elevation) * std::sin(azimuth),
                      15 * std::sin(elevation)};
  RadarWorld world(panel(1, 1), array, to, {0, 0, 0});
  world.add_path(0, 0, {}, {}, {});
  FrameResult frame = world.frame();
  frame.paths.doppler_hz = {0};
  return world.row(frame).detections;
}

}  // namespace

TEST_CASE("a receiving array tells azimuth, elevation or both, as its elements allow") {
  for (const double azimuth : {-0.6, 0.0, 0.3}) {
    const RadarDetections line = seen_at(panel(1, 8), azimuth, 0);
    REQUIRE(line.size() >= 1);
    CHECK(std::abs(line.azimuth_rad[0] - azimuth) < 1e-3);
    CHECK(std::isnan(line.elevation_rad[0]));
    const RadarDetections square = seen_at(panel(6, 6), azimuth, -0.25);
    REQUIRE(square.size() >= 1);
    CHECK(std::abs(square.azimuth_rad[0] - azimuth) < 1e-3);
    CHECK(std::abs(square.elevation_rad[0] + 0.25) < 1e-3);
  }
  const RadarDetections column = seen_at(panel(8, 1), 0, 0.4);
  REQUIRE(column.size() >= 1);
  CHECK(std::abs(column.elevation_rad[0] - 0.4) < 1e-3);
  CHECK(std::isnan(column.azimuth_rad[0]));
}

// The elements of the transmitter are as far apart as the receiver's array is wide, so that pairs are 12 in a line.
TEST_CASE("a monostatic radar looks with the virtual array of both ends, and an antenna that is turned with its axes") {
  for (const bool turned : {false, true}) {
    const double azimuth = 0.2, turn = turned ? -0.3 : 0;
    ArrayConfig sent = panel(1, 3, 2);
    RadarWorld world(sent, panel(1, 4), {0, 0, 0}, {0, 0, 0}, {turn / radians, 0, 0});
    world.config.transmitters[0].orientation_deg = {0, 0, 0};
    world.radar.kind = "monostatic";
    const glm::dvec3 normal{std::cos(azimuth), std::sin(azimuth), 0};
    world.add_reflections(0, 0, {world.add_plane(normal, 12.0 * normal, conductor())});
    FrameResult frame = world.frame();
    frame.paths.doppler_hz = {0};
    const RadarDetections found = world.row(frame).detections;
    REQUIRE(found.size() >= 1);
    CHECK(std::abs(found.range_m[0] - 12) < 0.05);
    CHECK(std::abs(found.azimuth_rad[0] - (azimuth - turn)) < 3e-3);  // mirrors bend waves a little: 12 m are near
    CHECK(std::isnan(found.elevation_rad[0]) == true);
  }
}

TEST_CASE("ends of a monostatic radar that are more than 1 m apart have no virtual array") {
  const auto azimuth = [](const char* kind, double apart_m) {
    RadarWorld world(panel(1, 3, 2), panel(1, 4), {0, apart_m, 0}, {0, 0, 0});
    world.config.transmitters[0].orientation_deg = {0, 0, 0};
    world.radar.kind = *RadarKind::parse(kind);
    const glm::dvec3 normal{std::cos(0.2), std::sin(0.2), 0};
    world.add_reflections(0, 0, {world.add_plane(normal, 12.0 * normal, conductor())});
    FrameResult frame = world.frame();
    frame.paths.doppler_hz = {0};
    const RadarDetections found = world.row(frame).detections;
    REQUIRE(found.size() >= 1);
    return found.azimuth_rad[0];
  };
  CHECK(azimuth("monostatic", 0.99) != azimuth("bistatic", 0.99));
  CHECK(azimuth("monostatic", 1.01) == azimuth("bistatic", 1.01));
}
