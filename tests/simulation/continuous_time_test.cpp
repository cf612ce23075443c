// SPDX-License-Identifier: Apache-2.0
// Tests trace.discover_every_s: compares frames every millisecond, some of which launch no rays, with frames that all
// launch them.
#include <map>

#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Cars that talk to each other and to a mast in the streets of a small city; one appears after a quarter of a second.
Config city(double end_s, double step_s) {
  Config config = config_of("", {{3, 5, 6}}, {{52, -7, 1.5}, {-46, 4, 1.5}}, 100000, 3);
  config.scene.generate = "--blocks 4x4";
  config.radio.frequency_hz = carrier_hz;
  add_vehicles(config,
               {{"a", "passenger", {-60, -3.1, 0}, {11.3, 0.02, 0}, 0, 1},
                {"b", "passenger", {2.9, 70, 0}, {0.01, -9.1, 0}, 0.255, 1},
                {"lorry", "truck", {64, 3.2, 0}, {-8.7, -0.03, 0}, 0, 1}},
               0.05);
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.7}}};
  config.time = {0, end_s, step_s};
  return config;
}

double power_of_rows(const Paths& paths, const std::vector<uint32_t>& found, bool lost) {
  double sum = 0;
  for (size_t i = 0; i < paths.size(); ++i)
    if ((found[i] == no_row) == lost) sum += std::pow(10, paths.gain_db[i] / 10);
  return sum;
}

}  // namespace

TEST_CASE("frames between launches have the paths of frames that all launch, and rays where somebody appears") {
  Config config = city(0.5, 0.01);
  Simulation all(config);
  config.trace.discover_every_s = 0.1;
  Simulation spared(config);
  config.trace.reuse = false;
  config.trace.discover_every_s = 0;
  config.trace.rays = 2000000;
  Simulation large(config);
  double lost = 0, power = 0;
  for (uint32_t frame = 0; frame <= 50; ++frame) {
    CAPTURE(frame);
    const FrameResult expected = all.run_frame(frame), found = spared.run_frame(frame);
    // b appears at frame 26, which is the first of its intervals.
    CHECK((found.counts.rays > 0) == (frame <= 20 ? frame % 10 == 0 : frame % 10 == 6));
    CHECK((found.missed.frames > 0) == (found.counts.rays > 0));
    CHECK(found.late.discoveries == (frame > 0 && found.counts.rays > 0 ? 1 : 0));
    if (frame % 10 == 5) CHECK(missing(found.paths, large.run_frame(frame).paths) == 0);
    const std::vector<uint32_t> counterpart = counterparts(expected.paths, found.paths);
    lost += power_of_rows(expected.paths, counterpart, true);
    power += power_of_rows(expected.paths, counterpart, false) + power_of_rows(expected.paths, counterpart, true);
  }
  MESSAGE("share of the power that frames without rays lose: " << lost / power);
  CHECK(lost / power < 1e-3);
}

TEST_CASE("what is late is what the sequences known before do not give: here the walls that a newcomer sees") {
  Config config = city(0.5, 0.5);
  config.trace.discover_every_s = 0.1;
  Simulation simulation(config);
  simulation.run_frame(0);
  const FrameResult second = simulation.run_frame(1);
  REQUIRE(second.late.discoveries == 1);
  CHECK(second.late.paths > 0);
  CHECK(second.late.paths < second.paths.size());
  CHECK(second.late.power > 0);
  double power = 0;
  for (size_t i = 0; i < second.paths.size(); ++i) power += std::pow(10, second.paths.gain_db[i] / 10);
  CHECK(second.late.all == doctest::Approx(power));
  CHECK(second.late.largest_share == second.late.power / second.late.all);
  simulation.forget();
  CHECK(simulation.run_frame(1).late.discoveries == 0);
}

TEST_CASE("phases go on between launches: Doppler shifts are those of central differences of the delays") {
  Config config = city(0.1, 0.001);
  config.trace.discover_every_s = 0.1;
  Simulation simulation(config);
  // This key distinguishes paths of one world: ends, then surfaces with the vehicles that they belong to.
  const auto rows = [](const Paths& paths) {
    std::map<std::vector<uint32_t>, size_t> out;
    for (size_t i = 0; i < paths.size(); ++i) {
      std::vector<uint32_t> key{paths.tx[i], paths.rx[i]};
      for (size_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
        key.insert(key.end(), {paths.vertex_surface[k], paths.vertex_instance[k]});
      CHECK(out.emplace(key, i).second);
    }
    return out;
  };
  simulation.run_frame(0);
  const FrameResult before = simulation.run_frame(40), result = simulation.run_frame(41),
                    after = simulation.run_frame(42);
  CHECK(before.counts.rays + result.counts.rays + after.counts.rays == 0);
  const auto row_before = rows(before.paths), row_after = rows(after.paths);
  size_t compared = 0;
  for (const auto& [key, i] : rows(result.paths)) {
    if (!row_before.contains(key) || !row_after.contains(key)) continue;
    const double change_s = after.paths.delay_s[row_after.at(key)] - before.paths.delay_s[row_before.at(key)];
    const double expected_hz = -carrier_hz * change_s / (simulation.time_s(42) - simulation.time_s(40));
    CAPTURE(result.paths.doppler_hz[i]);
    CHECK(std::abs(result.paths.doppler_hz[i] - expected_hz) < std::max(1e-3, 1e-6 * std::abs(expected_hz)));
    ++compared;
  }
  CHECK(compared > 30);
}
