// SPDX-License-Identifier: Apache-2.0
// Thresholds: false alarms as often as they were asked for, and sums over squares against sums of cells.
#include "radar/detections.hpp"

#include <cmath>

#include "radar/one_radar.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("noise has the power of its figure, and is above thresholds as often as it was asked to") {
  RadarWorld world({panel(1, 1), panel(1, 1), {0, 0, 5}, {100, 0, 5}});
  world.add_path(0, 0, {}, {}, {});  // too late, so that there is noise alone
  RadarConfig& radar = world.radar;
  radar.chirps = radar.samples = 256;
  radar.noise_figure_db = 12;
  radar.seed = 5;
  radar.range_window = radar.doppler_window = "none";
  FrameResult frame = world.frame();
  frame.paths.doppler_hz = {0};
  const double power_w = 1.380649e-23 * 290 * std::pow(10, 1.2) * 256 / 20e-6;
  const auto alarms = [&](double probability) {
    radar.false_alarm = probability;
    return world.row(frame).detections.size();
  };
  double sum_w = 0;
  const RadarRow noise = world.row(frame);
  for (const Complex& value : noise.cube) sum_w += std::norm(value);
  // Windows have the sum 1, so a cell has the 256 x 256th part of the power of a sample.
  CHECK(sum_w == near(power_w, 0.02));
  // One in nine of cells that are independent is the largest of its neighbours, and so are all high ones.
  const size_t few = alarms(1e-3), many = alarms(1e-2);
  CHECK(few > 30);
  CHECK(few < 110);
  CHECK(many > 350);
  CHECK(many < 800);
  CHECK(world.row(frame).cube == noise.cube);
  frame.frame = 1;
  CHECK(world.row(frame).cube != noise.cube);
  frame.frame = 0;
  frame.world.time_s += 1e-3;  // between live frames, numbers do not advance
  CHECK(world.row(frame).cube != noise.cube);
  frame.world.time_s -= 1e-3;
  radar.name = "rear";  // another radar of the same link
  CHECK(world.row(frame).cube != noise.cube);
  radar.name = "front";
  radar.seed = 6;
  CHECK(world.row(frame).cube != noise.cube);
}

TEST_CASE("thresholds are the mean of the cells around, on circles, and detections the largest of their neighbours") {
  RadarConfig radar = front_radar();
  radar.chirps = 16;
  radar.samples = 20;
  radar.guard = 1;
  radar.training = 3;
  radar.false_alarm = 0.1;
  std::vector<double> map(16 * 20);
  for (size_t i = 0; i < map.size(); ++i) map[i] = 1 + 0.5 * std::sin(0.7 * static_cast<double>(i * i % 97));
  map[0] = 40;  // at the corner of both circles
  map[7 * 20 + 11] = 30;
  map[7 * 20 + 12] = 20;  // its neighbour is larger
  const auto mean_around = [&](int n, int s) {
    double sum = 0;
    for (int a = -3; a <= 3; ++a)
      for (int b = -3; b <= 3; ++b)
        if (std::max(std::abs(a), std::abs(b)) > 1)
          sum += map[static_cast<size_t>((n + a + 16) % 16 * 20 + (s + b + 20) % 20)];
    return sum / 40;
  };
  const auto found = detected_cells(map, radar);
  REQUIRE(found.size() == 2);
  CHECK(found[0].shift == 0);
  CHECK(found[0].delay == 0);
  CHECK(found[1].shift == 7);
  CHECK(found[1].delay == 11);
  const double factor = 40 * (std::pow(0.1, -1.0 / 40) - 1);
  CHECK(found[0].threshold_w == near(mean_around(0, 0) * factor, 1e-12));
  CHECK(found[1].threshold_w == near(mean_around(7, 11) * factor, 1e-12));
}
