// SPDX-License-Identifier: Apache-2.0
// Times as seconds since 1970, which doubles keep to 0.24 us: every reader gives the frames that it gives for times
// from zero, and a frame at the time of a sample shows that sample.
#include <cmath>

#include "base/times.hpp"
#include "motion/frame_clock.hpp"
#include "motion/pose.hpp"
#include "motion/readers.hpp"
#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

namespace {

// `whole` seconds and k steps of so many decimals, as files write it: integers alone.
std::string decimal_time(uint64_t whole, uint64_t steps, int decimals) {
  uint64_t unit = 1;
  for (int i = 0; i < decimals; ++i) unit *= 10;
  std::string rest = std::to_string(steps % unit);
  return std::to_string(whole + steps / unit) + "." + std::string(static_cast<size_t>(decimals) - rest.size(), '0') +
         rest;
}

// A car at 10 m/s along x.
std::string csv_drive(uint64_t whole, uint64_t samples, int decimals) {
  std::string out = "time,id,x,y,speed\n";
  for (uint64_t k = 0; k < samples; ++k)
    out +=
        decimal_time(whole, k, decimals) + ",a," + std::to_string(10 * double(k) * std::pow(10, -decimals)) + ",0,10\n";
  return out;
}

uint64_t frames_of(const Trajectories& t) { return FrameClock(t.first_time_s, t.last_time_s, t.step_s).frame_count(); }

}  // namespace

TEST_CASE("CSV at 10, 100 and 1000 Hz has a frame for each sample, whatever its times count from") {
  for (const uint64_t whole : {uint64_t{0}, uint64_t{1700000000}, uint64_t{1763999999}, uint64_t{4000000000}})
    for (const int decimals : {1, 2, 3})
      for (const uint64_t samples : {2, 3, 5, 100, 1001}) {
        CAPTURE(whole);
        CAPTURE(decimals);
        CAPTURE(samples);
        const Trajectories t = read_text(csv_drive(whole, samples, decimals));
        CHECK(frames_of(t) == samples);
        CHECK(std::abs(t.step_s - std::pow(10, -decimals)) < 1e-12);
        const FrameClock clock(t.first_time_s, t.last_time_s, t.step_s);
        for (uint64_t frame = 0; frame < samples; ++frame) {
          const double x = 10 * double(frame) * std::pow(10, -decimals);
          REQUIRE(pose_at(t.tracks[0], clock.time_s(frame)));
          CHECK(std::abs(pose_at(t.tracks[0], clock.time_s(frame))->position_m.x - x) < 2e-5);
        }
      }
}

TEST_CASE("a long drive since 1970 does not creep away from its samples") {
  constexpr uint64_t samples = 200000;
  const Trajectories t = read_text(csv_drive(1700000000, samples, 1));
  CHECK(t.step_s == 0.1);
  CHECK(frames_of(t) == samples);
  // Thirds of a second have no decimal form: their mean is the step.
  std::string rows = "time,id,x,y\n";
  for (int k = 0; k < 3000; ++k) {
    char time[64];
    std::snprintf(time, sizeof time, "%.7f", 1.7e9 + k / 30.0);
    rows += std::string(time) + ",a," + std::to_string(k) + ",0\n";
  }
  const Trajectories thirds = read_text(rows);
  CHECK(std::abs(thirds.step_s - 1 / 30.0) < 1e-9);
  CHECK(frames_of(thirds) == 3000);
}

TEST_CASE("FCD since 1970, and uneven steps as at times from zero") {
  const auto fcd_drive = [](uint64_t whole) {
    std::string steps;
    for (const uint64_t k : {0, 33, 67, 100, 133, 167, 200})
      steps += timestep(decimal_time(whole, k, 3), "<vehicle id=\"a\" x=\"" + std::to_string(k) + "\" y=\"0\"/>");
    return read_text(fcd(steps));
  };
  CHECK(fcd_drive(1700000000).step_s == 0.033);
  CHECK(frames_of(fcd_drive(1700000000)) == frames_of(fcd_drive(0)));
  CHECK(fcd_drive(1700000000).tracks[0].segments == fcd_drive(0).tracks[0].segments);
}

TEST_CASE("GPX counts from its first point, to the last digit of its times") {
  TrajectoryOptions options;
  options.from_degrees = [](const glm::dvec2& degrees) { return 1e5 * degrees; };
  for (const uint64_t points : {3, 5, 11, 601}) {
    std::string text = "<gpx><trk><trkseg>";
    for (uint64_t k = 0; k < points; ++k) {
      const uint64_t tenths = k % 10, seconds_of = k / 10 % 60, minutes = k / 600;
      char point[200];
      std::snprintf(point, sizeof point,
                    "<trkpt lat=\"48\" lon=\"%.6f\"><time>2026-11-24T10:%02d:%02d.%dZ</time></trkpt>\n",
                    11 + 1e-6 * double(k), int(minutes), int(seconds_of), int(tenths));
      text += point;
    }
    const Trajectories t = read_text(text + "</trkseg></trk></gpx>", options, "a.gpx");
    CAPTURE(points);
    CHECK(frames_of(t) == points);
    for (uint64_t k = 0; k < points; ++k)
      CHECK(std::abs(t.tracks[0].samples[k].time_s - double(k) / 10) < 1e-13 * double(points));
  }
}

TEST_CASE("the clock: times that are given, and steps that doubles cannot tell apart") {
  CHECK(FrameClock(1.7e9, 1.7e9 + 0.05, 0.01).frame_count() == 6);
  CHECK(FrameClock(1e12, 1e12 + 0.05, 0.01).frame_count() == 6);
  CHECK(FrameClock(1.7e9 + 0.1, 1.7e9 + 0.4, 0.1).frame_count() == 4);
  CHECK(FrameClock(1.7e9, 1.7e9 + 0.35, 0.1).frame_count() == 4);  // the end is no frame
  CHECK(FrameClock(-1.7e9 - 0.3, -1.7e9, 0.1).frame_count() == 4);
  CHECK_THROWS_WITH_AS(FrameClock(1.7e9, 1.7e9 + 1, 5e-7),
                       Contains("times near 1700000001 s are only known to 2.4e-07 s"), ConfigError);
  CHECK_NOTHROW(FrameClock(1e17, 1e17, 1));
}

TEST_CASE("a vehicle is there at its last sample, although the time of the frame is a rounding beside it") {
  for (const double zero_s : {0.0, 1.7e9, 1e12}) {
    CAPTURE(zero_s);
    Track track{"a", 0, {}, {0}};
    for (int k = 0; k < 3; ++k) {
      Sample s;
      s.time_s = zero_s + 0.1 * k;
      s.position_m.x = k;
      s.yaw_rad = s.pitch_rad = s.speed_m_s = 0;
      s.velocity_m_s = glm::dvec3(10, 0, 0);
      track.samples.push_back(s);
    }
    const double last_s = track.samples.back().time_s;
    CHECK(pose_at(track, last_s + time_spacing_s(last_s)));
    CHECK(pose_at(track, zero_s - time_spacing_s(zero_s)));
    CHECK_FALSE(pose_at(track, last_s + 0.01));
  }
}

TEST_CASE("spacings, the simplest decimal, and times for people") {
  CHECK(time_spacing_s(1) == std::ldexp(1, -52));
  CHECK(time_spacing_s(-1.7e9) == std::ldexp(1, -22));
  CHECK(time_tolerance_s(100) == 1e-6);
  CHECK(time_tolerance_s(1e12) == 2 * std::ldexp(1, -13));
  CHECK(simplest_decimal(0.10000014, 2.4e-7) == 0.1);
  CHECK(simplest_decimal(0.033333312, 2.4e-7) == 0.0333333);
  CHECK(simplest_decimal(0.0999, 0.002) == 0.1);
  CHECK(simplest_decimal(1 / 3.0, 0) == 1 / 3.0);
  CHECK(simplest_decimal(0, 0) == 0);
  CHECK(time_text(1.7e9 + 0.1) == "1700000000.1");
  CHECK(time_text(1.7e9) == "1700000000");
  CHECK(time_text(0.1 + 0.2) == "0.3");
  CHECK(time_text(-2.5) == "-2.5");
  CHECK(time_text(0) == "0");
  CHECK(time_text(2e-5) == "2e-05");
  CHECK(time_text(1 / 3.0) == "0.333333");
}
