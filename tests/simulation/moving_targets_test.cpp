// SPDX-License-Identifier: Apache-2.0
// Targets that move: bodies that hide them, Doppler shifts against central differences, and the example of a radar.
#include <map>

#include "folders.hpp"
#include "simulation/radar_world.hpp"
#include "wavetracer/config_file.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("vehicles: no body hides its own points, others do; own antennas do not see them; shifts are exact") {
  const SceneFile file(far_plate);
  Config config = config_of(file.path(), {{-30, 0, 1}}, {{-30, 0.0, 1}}, 2000, 2);
  config.radio.frequency_hz = radar_hz;
  config.tracks = {{.id = "near", .waypoints = {{0, 0, 0, 0}, {1, 12, 1, 0}, {2, 20, 9, 0}}},
                   {.id = "behind", .waypoints = {{0, 30, 0, 0}, {2, 60, 0, 0}}},
                   {.id = "aside", .waypoints = {{0, 10, 25, 0}, {2, 40, 20, 0}}}};
  config.mounts = {{.name = "eye", .on = "near", .role = "receiver", .offset_m = {0, 0, 2.2}}};
  TargetModelConfig model;
  model.name = "car";
  model.on = "passenger";
  model.kind = "vehicle-points";
  config.target_models = {model};
  config.time = {1e-9, 1e-4, 1e-4};
  const auto names = Simulation(config).targets();
  REQUIRE(names.size() == 3);
  CHECK(names[2].name == "near/car");
  config.time = {0, 0, 1};
  const Paths start = run(config).paths;
  std::map<std::pair<uint32_t, uint32_t>, size_t> found;  // receiver and target
  for (const size_t i : echoes(start)) ++found[{start.rx[i], start.target[i]}];
  CHECK(found[{0, 2}] == 5);  // through its own body
  CHECK(found[{0, 1}] < 5);   // the car in front hides some
  CHECK(found[{0, 0}] == 5);
  CHECK(found[{1, 2}] == 0);  // its own antenna
  CHECK(found[{1, 0}] == 5);
  // A turning car, against central differences.
  const double time_s = 1.4, step_s = 1e-4;
  config.time = {time_s - step_s, time_s + step_s, step_s};
  config.trace.reuse = false;
  Simulation drive(config);
  REQUIRE(drive.frame_count() == 3);
  using Key = std::array<uint32_t, 3>;
  const auto rows = [&](const Paths& paths) {
    std::map<Key, size_t> out;
    for (const size_t i : echoes(paths))
      if (paths.depth[i] == 1) out[{paths.rx[i], paths.target[i], paths.vertex_surface[paths.vertex_offset[i]]}] = i;
    return out;
  };
  const Paths before = drive.run_frame(0).paths, now = drive.run_frame(1).paths, after = drive.run_frame(2).paths;
  const auto rows_before = rows(before), rows_after = rows(after);
  size_t compared = 0;
  for (const auto& [key, i] : rows(now)) {
    if (!rows_before.contains(key) || !rows_after.contains(key)) continue;
    const double change_s = after.delay_s[rows_after.at(key)] - before.delay_s[rows_before.at(key)];
    const double expected_hz = -radar_hz * change_s / (drive.time_s(2) - drive.time_s(0));
    CAPTURE(expected_hz);
    CHECK(std::abs(now.doppler_hz[i] - expected_hz) < std::max(0.02, 1e-5 * std::abs(expected_hz)));
    compared += std::abs(expected_hz) > 100;
  }
  CHECK(compared > 10);
}

TEST_CASE("the example of a radar: the car ahead, the one that comes and the pedestrian, with their speeds") {
  const std::string file = source_folder() + "/configs/radar.toml";
  Simulation simulation(load_config(file, {"trace.rays=2000"}));
  const Paths paths = simulation.run_frame(0).paths;
  std::map<std::string, double> direct_hz;
  size_t reflected = 0;
  for (const size_t i : echoes(paths)) {
    const std::string name = simulation.targets()[paths.target[i]].name;
    if (paths.depth[i] > 1)
      ++reflected;
    else
      direct_hz[name] = paths.doppler_hz[i];
  }
  CHECK(reflected > 10);
  REQUIRE(direct_hz.size() == 3);  // its own vehicle is none
  const double of_a_metre = 2 / radar_wavelength_m;
  CHECK(direct_hz["ahead/car"] == doctest::Approx(1 * of_a_metre).epsilon(0.01));
  CHECK(direct_hz["oncoming/car"] == doctest::Approx(27 * of_a_metre).epsilon(0.01));
  CHECK(direct_hz["pedestrian"] > 13 * of_a_metre);
}
