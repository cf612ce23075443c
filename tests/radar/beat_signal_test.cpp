// SPDX-License-Identifier: Apache-2.0
// Samples of chirps against the phases of what is sent and received, levels and places of cubes, left-out paths.
#include "radar/beat_signal.hpp"

#include <tbb/global_control.h>

#include <cmath>
#include <complex>

#include "radar/one_radar.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A path of one element each, whose delay and shift are set.
FrameResult lone_path(RadarWorld world, double delay_s, double doppler_hz) {
  world.add_path(0, 0, {}, {}, {});
  FrameResult frame = world.frame();
  frame.paths.delay_s[0] = delay_s;
  frame.paths.doppler_hz = {doppler_hz};
  frame.paths.a[0][0] = {3e-4, -1e-4};
  return frame;
}

RadarWorld lone_world() { return {panel(1, 1), panel(1, 1), {0, 0, 5}, {10, 0, 5}}; }

}  // namespace

TEST_CASE("every sample is the chirp that is sent times the conjugate of the one that arrives") {
  RadarWorld world = lone_world();
  const double delay_s = 77.7e-9, shift_hz = -9000;
  const FrameResult frame = lone_path(world, delay_s, shift_hz);
  const RadarConfig& radar = world.radar;
  const BeatSignal signal = beat_signal(ElementModel(world.config, world.scene), frame, {0, 0}, radar, 30);
  const double slope = radar.bandwidth_hz / radar.chirp_s, low_hz = radar_carrier_hz - radar.bandwidth_hz / 2;
  const auto sent_cycles = [&](double t) { return low_hz * t + slope * t * t / 2; };
  for (const auto& [chirp, sample] : {std::pair(0, 0), {0, 127}, {17, 64}, {63, 127}}) {
    const double t = sample * radar.chirp_s / radar.samples;
    const double tau = delay_s - shift_hz / radar_carrier_hz * (chirp * radar.spacing_s() + t);
    const double cycles = sent_cycles(t - tau) - sent_cycles(t);
    const Complex wanted = frame.paths.a[0][0] * std::polar(1.0, 2 * std::numbers::pi * (cycles - std::floor(cycles)));
    const size_t at = signal.row(0, 0, static_cast<size_t>(chirp)) + static_cast<size_t>(sample);
    CAPTURE(chirp);
    CHECK(std::abs(Complex(signal.re[at], signal.im[at]) - wanted) < 1e-6 * std::abs(wanted));
  }
}

TEST_CASE("a target is in the cell of its delay and shift, with its power; neighbours have the windows' levels") {
  RadarWorld world = lone_world();
  const double shift_hz = 5 / (64 * 25e-6);
  const FrameResult frame = lone_path(world, 40e-9, shift_hz);
  const double level_dbm = 30 + 10 * std::log10(std::norm(frame.paths.a[0][0]));
  const auto strongest = [&](const char* window) {
    world.radar.range_window = world.radar.doppler_window = *RadarWindow::parse(window);
    return world.row(frame);
  };
  for (const char* window : {"hann", "hamming", "blackman", "none"}) {
    const RadarRow row = strongest(window);
    CHECK(highest(row, 128) == std::pair<size_t, size_t>{32 + 5, 40});
    CHECK(std::abs(row.power_dbm[37 * 128 + 40] - level_dbm) < 0.35);  // its shift moves the beat within a cell
    REQUIRE(row.detections.size() >= 1);
    CHECK(std::abs(row.detections.delay_s[0] - 40e-9) < 0.25e-9);
    CHECK(std::abs(row.detections.doppler_hz[0] - shift_hz) < 80);
    CHECK(row.detections.power_dbm[0] == row.power_dbm[37 * 128 + 40]);
    CHECK(std::isnan(row.detections.azimuth_rad[0]));
  }
  const FrameResult still = lone_path(world, 40.5e-9, 0);
  world.radar.range_window = "hann";
  const RadarRow row = world.row(still);
  const double level = 30 + 10 * std::log10(std::norm(still.paths.a[0][0]));
  for (int cell = 37; cell < 45; ++cell) {
    const double x = cell - 40.5, sinc = std::sin(std::numbers::pi * x) / (std::numbers::pi * x);
    CAPTURE(cell);
    CHECK(std::abs(row.power_dbm[32 * 128 + static_cast<size_t>(cell)] - level -
                   20 * std::log10(std::abs(sinc / (1 - x * x)))) < 0.3);
  }
}

TEST_CASE("late paths and the direct path are left out, and the first are counted") {
  RadarWorld world = lone_world();
  FrameResult frame = lone_path(world, 129e-9, 0);
  CHECK(world.row(frame).left_out == 1);
  CHECK(std::isinf(world.row(frame).spectrum_dbm[32]));
  frame.paths.delay_s[0] = 127e-9;
  CHECK(world.row(frame).left_out == 0);
  CHECK(std::isfinite(world.row(frame).spectrum_dbm[32]));
  world.radar.direct = false;
  const RadarRow none = world.row(frame);
  CHECK(std::isinf(none.spectrum_dbm[32]));
  CHECK(none.detections.size() == 0);
}

TEST_CASE("antennas that send in turns have their phases back, and cores do not change a bit") {
  RadarWorld world({panel(1, 3), panel(2, 2), {0, 0, 5}, {9.4, 1.5, 6}});
  world.add_path(0, 0, {}, {}, {});
  FrameResult frame = world.frame();
  frame.paths.doppler_hz = {3000};
  const RadarRow together = world.row(frame);
  world.radar.turns = true;
  world.radar.interval_s = 25e-6 / 3 * 2.5;  // at least a chirp; the same shifts would need a third
  const RadarRow in_turns = world.row(frame);
  const RadarAxes axes = world.axes();
  const auto [n, s] = highest(in_turns, 128);
  const auto [m, r] = highest(together, 128);
  CHECK(s == r);
  CHECK(std::abs(axes.doppler_hz[n] - 3000) < 300);
  for (size_t pair = 1; pair < 12; ++pair) {
    const auto of = [&](const RadarRow& row, size_t at) { return row.cube[pair * 64 * 128 + at] / row.cube[at]; };
    // The shift is not in the middle of a cell, for which phases are corrected: at most half a cell over two intervals.
    CHECK(std::abs(std::arg(of(in_turns, n * 128 + s) / of(together, m * 128 + r))) < 0.08);
  }
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const RadarRow alone = world.row(frame);
  CHECK(alone.cube == in_turns.cube);
  CHECK(alone.power_dbm == in_turns.power_dbm);
}
