// SPDX-License-Identifier: Apache-2.0
// Compares Doppler shifts of a drive with central differences of the delays of the same paths, a tenth of a millisecond
// earlier and later: antennas on vehicles, vehicles as mirrors, on straight ways and in a turn.
#include <map>

#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double frame_step_s = 1e-4;

// The key distinguishes paths of one world: ends, then surfaces with the vehicles that they belong to.
std::map<std::vector<uint32_t>, size_t> rows_by_surfaces(const Paths& paths) {
  std::map<std::vector<uint32_t>, size_t> rows;
  for (size_t i = 0; i < paths.size(); ++i) {
    std::vector<uint32_t> key{paths.tx[i], paths.rx[i]};
    for (size_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) {
      key.push_back(paths.vertex_surface[k]);
      key.push_back(paths.vertex_instance[k]);
    }
    CHECK(rows.emplace(key, i).second);
  }
  return rows;
}

struct Checked {
  size_t paths = 0, by_vehicles = 0, of_all = 0;
  double largest_hz = 0;
};

// Three frames around time_s.
Checked check_shifts(Config config, double time_s) {
  config.radio.frequency_hz = carrier_hz;
  config.time = {time_s - frame_step_s, time_s + frame_step_s, frame_step_s};
  config.trace.reuse = false;
  Simulation simulation(config);
  REQUIRE(simulation.frame_count() == 3);
  const Paths before = simulation.run_frame(0).paths, paths = simulation.run_frame(1).paths,
              after = simulation.run_frame(2).paths;
  const auto row_before = rows_by_surfaces(before), row_after = rows_by_surfaces(after);
  Checked out;
  out.of_all = paths.size();
  for (const auto& [key, i] : rows_by_surfaces(paths)) {
    if (!row_before.contains(key) || !row_after.contains(key)) continue;
    const double change_s = after.delay_s[row_after.at(key)] - before.delay_s[row_before.at(key)];
    const double expected_hz = -carrier_hz * change_s / (simulation.time_s(2) - simulation.time_s(0));
    CAPTURE(key);
    CAPTURE(expected_hz);
    CAPTURE(paths.doppler_hz[i]);
    CHECK(std::abs(paths.doppler_hz[i] - expected_hz) < std::max(1e-4, 1e-6 * std::abs(expected_hz)));
    out.by_vehicles += by_vehicle(paths, i);
    out.largest_hz = std::max(out.largest_hz, std::abs(expected_hz));
    ++out.paths;
  }
  return out;
}

// Antennas on the cars, one at the roadside; trucks are mirrors.
Config traffic(const std::filesystem::path& scene) {
  Config config = config_of(scene, {}, {{22, 9.5, 2.2}, {-14, -8.3, 1.4}}, 400000, 3);
  config.vehicle_types = vehicle_types();
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {-0.4, 0.2, 1.7}}};
  return config;
}

}  // namespace

TEST_CASE("constant velocities: every shift is that of the delay") {
  const SceneFile file(street());
  Config config = traffic(file.path());
  add_vehicles(config,
               {{"a", "passenger", {-25, -4.1, 0}, {13.7, 0.3, 0}, 0, 3},
                {"b", "passenger", {31, 2.2, 0}, {-16.1, 0.9, 0.2}, 0, 3},
                {"lorry", "truck", {2, 7.7, 0}, {-9.3, -0.4, 0}, 0, 3},
                {"tipper", "truck", {-8, -9.6, 0}, {8.1, 0.6, 0}, 0, 3}},
               1);
  Checked sum;
  for (const double time_s : {0.4, 1.3, 2.1}) {
    const Checked checked = check_shifts(config, time_s);
    CHECK(checked.paths > 0.99 * static_cast<double>(checked.of_all));
    sum.paths += checked.paths;
    sum.by_vehicles += checked.by_vehicles;
    sum.largest_hz = std::max(sum.largest_hz, checked.largest_hz);
  }
  CHECK(sum.paths > 100);
  CHECK(sum.by_vehicles > 10);
  CHECK(sum.largest_hz > 400);
}

TEST_CASE("in turns, uphill and braking: every shift is that of the delay") {
  const SceneFile file(street());
  Config config = traffic(file.path());
  config.tracks = {
      {"a", "passenger", {{0, -20, -4, 0}, {1, -9, -3.6, 0.1}, {2, 1, -1, 0.4}, {3, 5, 6, 0.6}, {4, 5.4, 11, 0.6}}},
      {"b", "passenger", {{0, 24, 3, 0}, {1, 14, 3.4, 0}, {2, 8, 3, 0}, {3, 6.5, 2.6, 0}, {4, 6.5, 2.6, 0}}},
      {"lorry", "truck", {{0, -12, 8.6, 0}, {1, -5, 8.2, 0.3}, {2, 0, 5.5, 0.5}, {3, 1, 0, 0.4}, {4, 0, -6, 0}}}};
  Checked sum;
  for (const double time_s : {0.63, 1.37, 1.81, 2.44}) {
    const Checked checked = check_shifts(config, time_s);
    CHECK(checked.paths > 0.97 * static_cast<double>(checked.of_all));
    sum.paths += checked.paths;
    sum.by_vehicles += checked.by_vehicles;
  }
  CHECK(sum.paths > 100);
  CHECK(sum.by_vehicles > 10);
}
