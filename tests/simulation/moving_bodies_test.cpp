// SPDX-License-Identifier: Apache-2.0
// Bodies by physical optics in runs, with a mirror before and after them, and shifts of one that turns.
#include <map>

#include "simulation/body_world.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("a mirror before and after a body: the fields of its images") {
  const SceneFile scene(std::vector<Quad>{{{-500, -500, 8}, {1000, 0, 0}, {0, 1000, 0}}}), plate(one_plate);
  const glm::dvec3 a = body_place + glm::dvec3(30, 2, 0.4), b = body_place + glm::dvec3(25, -3, 1.1);
  Config config = body_world(scene, plate, {a}, {b}, 3, true);
  config.trace.target_reflections = 1;
  Simulation simulation(config);
  const Body mesh = body_of(simulation.models().front(), body_hz);
  const Paths paths = simulation.run_frame(0).paths;
  std::map<std::pair<bool, bool>, std::complex<double>> found;  // mirrors before and after; horizontal to horizontal
  for (const size_t i : echoes(paths)) {
    const uint64_t first = paths.vertex_offset[i], last = paths.vertex_offset[i + 1] - 1;
    const std::pair key(paths.vertex_interaction[first] == reflection, paths.vertex_interaction[last] == reflection);
    found[key] += paths.a[i][3] * std::polar(1.0, -2 * std::numbers::pi * body_hz * paths.delay_s[i]);
  }
  REQUIRE(found.size() == 4);
  const auto image = [](glm::dvec3 p, bool mirrored) { return mirrored ? glm::dvec3(p.x, p.y, 16 - p.z) : p; };
  for (const auto& [key, value] : found) {
    const auto& [before, after] = key;
    const double sign = before == after ? 1 : -1;  // a conductor turns the horizontal field
    const Channel expected = alone(mesh, image(a, before), image(b, after));
    CAPTURE(before);
    CAPTURE(after);
    CHECK(std::abs(value - sign * expected[3]) < 0.02 * std::abs(expected[3]));
  }
}

TEST_CASE("shifts of a plate that turns are those of the lengths of its paths") {
  const SceneFile scene(far_plate), plate(one_plate);
  Config config = body_world(scene, plate, {{40, 5, 11}}, {{38, -4, 9}}, 1, true);
  config.tracks[0].waypoints = {{0, 0, 0, 10}, {1, 9, 1, 10}, {2, 14, 8, 10}, {3, 15, 17, 10}};
  constexpr double time_s = 1.2, step_s = 1e-5;
  config.time = {time_s - step_s, time_s + step_s, step_s};
  config.trace.reuse = false;
  Simulation drive(config);
  REQUIRE(drive.frame_count() == 3);
  const auto rows = [](const Paths& paths) {
    std::map<uint32_t, size_t> out;
    for (const size_t i : echoes(paths)) out[paths.vertex_surface[paths.vertex_offset[i]]] = i;
    return out;
  };
  const Paths before = drive.run_frame(0).paths, now = drive.run_frame(1).paths, after = drive.run_frame(2).paths;
  const auto rows_before = rows(before), rows_after = rows(after);
  double least = 1e9, most = -1e9;
  REQUIRE(rows(now).size() > 10);
  for (const auto& [piece, i] : rows(now)) {
    const double change_s = after.delay_s[rows_after.at(piece)] - before.delay_s[rows_before.at(piece)];
    const double expected_hz = -body_hz * change_s / (drive.time_s(2) - drive.time_s(0));
    CHECK(std::abs(now.doppler_hz[i] - expected_hz) < 1e-6 * 2 * 10 / body_wave_m);
    least = std::min(least, expected_hz);
    most = std::max(most, expected_hz);
  }
  CHECK(most - least > 1);  // it turns
}
