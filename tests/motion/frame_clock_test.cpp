// SPDX-License-Identifier: Apache-2.0
// The clock of frames: counts and times despite rounding, and who is present in which order.
// Times of files are decimal, so k * step rarely hits them to the last bit.
#include "motion/frame_clock.hpp"

#include "motion_files.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using doctest::Contains;

TEST_CASE("frames are counted as if in decimal") {
  CHECK(FrameClock(0, 10, 0.1).frame_count() == 101);
  CHECK(FrameClock(0, 0.3, 0.1).frame_count() == 4);  // 3 * 0.1 > 0.3
  CHECK(FrameClock(0, 0.35, 0.1).frame_count() == 4);
  CHECK(FrameClock(5, 5, 1).frame_count() == 1);
  CHECK(FrameClock(-1, 1, 1e-3).frame_count() == 2001);
  CHECK(FrameClock(0, 86400, 0.01).frame_count() == 8640001);
}

TEST_CASE("times of frames never pass the end") {
  const FrameClock clock(0, 0.3, 0.1);
  CHECK(clock.time_s(0) == 0);
  CHECK(clock.time_s(3) == 0.3);
  CHECK_THROWS_WITH_AS(clock.time_s(4), Contains("there is no frame 4: the last one is 3"), ConfigError);
  CHECK(FrameClock(100, 200, 0.01).time_s(5000) == 150);
}

TEST_CASE("clocks that cannot run") {
  const double inf = std::numeric_limits<double>::infinity();
  for (double step : {0.0, -1.0, inf, not_given}) {
    CHECK_THROWS_WITH_AS(FrameClock(0, 1, step), Contains("must be positive"), ConfigError);
  }
  for (double last : {-1.0, inf, not_given}) {
    CHECK_THROWS_WITH_AS(FrameClock(0, last, 1), Contains("the end must not be before"), ConfigError);
  }
  CHECK_THROWS_WITH_AS(FrameClock(0, 1e9, 1e-9), Contains("use a longer time step"), ConfigError);
}

TEST_CASE("who is present in a frame") {
  std::string rows = "time,id,x,y,yaw,speed\n";
  for (int k = 0; k <= 10; ++k) {
    const std::string time = std::to_string(k / 10) + "." + std::to_string(k % 10);
    if (k <= 3) rows += time + ",b," + std::to_string(k) + ",0,0,10\n";
    if (k >= 2 && k <= 7) rows += time + ",c," + std::to_string(k) + ",5,0,10\n";
    if (k >= 2) rows += time + ",a," + std::to_string(k) + ",9,0,10\n";
  }
  const Trajectories t = read_text(rows);
  REQUIRE(t.tracks.size() == 3);
  const FrameClock clock(t.first_time_s, t.last_time_s, 0.05);
  REQUIRE(clock.frame_count() == 21);
  for (uint64_t frame = 0; frame < clock.frame_count(); ++frame) {
    CAPTURE(frame);
    std::string present;
    for (const PresentVehicle& v : vehicles_at(t, clock.time_s(frame))) {
      present += t.tracks[v.track].id;
      CHECK(v.pose.position_m.x == doctest::Approx(static_cast<double>(frame) / 2));
    }
    // Halves and tenths of a second are in the file; both ends of a vehicle's time are part of it.
    CHECK(present == (frame < 4 ? "b" : frame <= 6 ? "bac" : frame <= 14 ? "ac" : "a"));
  }
  CHECK(vehicles_at(t, 1.1).empty());
}
