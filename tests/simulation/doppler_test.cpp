// Doppler shifts of moving ends against central differences of exact lengths, reflections included, and closed forms.
// Two runs with the ends displaced see the same surfaces, so paths are matched by them.
#include <map>

#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double frequency_hz = 5.9e9, wavelength_m = speed_of_light / frequency_hz;

void move(RadioEnd& end, double seconds) {
  for (size_t axis = 0; axis < 3; ++axis) end.position_m[axis] += seconds * end.velocity_m_s[axis];
}

// Length by the surfaces of each path, in order from the transmitter.
std::map<std::vector<uint32_t>, double> lengths_after(Config config, double seconds) {
  move(config.transmitters[0], seconds);
  move(config.receivers[0], seconds);
  std::map<std::vector<uint32_t>, double> lengths;
  for (const Row& row : rows_of(run(config).paths, 0, 0)) lengths[row.surfaces] = row.delay_s * speed_of_light;
  return lengths;
}

}  // namespace

TEST_CASE("moving ends in a box: every path's shift is that of its length") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config = config_of(file.path(), {{1.37, 2.21, 1.55}}, {{6.13, 3.42, 0.87}}, 300000, 3);
  config.radio.frequency_hz = frequency_hz;
  config.transmitters[0].velocity_m_s = {21, -13, 2};
  config.receivers[0].velocity_m_s = {-17, 9, -1};
  const Paths paths = run(config).paths;
  REQUIRE(paths.size() == 63);
  constexpr double step_s = 1e-5;
  const auto before = lengths_after(config, -step_s), after = lengths_after(config, step_s);
  size_t matched = 0;
  double largest = 0;
  for (size_t i = 0; i < paths.size(); ++i) {
    const std::vector<uint32_t> surfaces(
        paths.vertex_surface.begin() + static_cast<std::ptrdiff_t>(paths.vertex_offset[i]),
        paths.vertex_surface.begin() + static_cast<std::ptrdiff_t>(paths.vertex_offset[i + 1]));
    if (!before.contains(surfaces) || !after.contains(surfaces)) continue;
    const double expected = -(after.at(surfaces) - before.at(surfaces)) / (2 * step_s) / wavelength_m;
    CAPTURE(i);
    CHECK(std::abs(paths.doppler_hz[i] - expected) < 1e-4 + 1e-6 * std::abs(expected));
    largest = std::max(largest, std::abs(expected));
    ++matched;
  }
  CHECK(matched == paths.size());
  CHECK(largest > 500);
}

TEST_CASE("closed forms: head-on, broadside, an echo of oneself") {
  const SceneFile file({Quad{{50, -100, -100}, {0, 200, 0}, {0, 0, 200}}});
  Config config = config_of(file.path(), {{0, 0, 0}}, {{10, 0, 0}}, 10000, 1);
  config.radio.frequency_hz = frequency_hz;
  config.transmitters[0].velocity_m_s = {30, 0, 0};
  const Paths paths = run(config).paths;
  REQUIRE(paths.size() == 2);
  CHECK(paths.doppler_hz[0] == doctest::Approx(30 / wavelength_m).epsilon(1e-12));  // towards the receiver
  CHECK(paths.doppler_hz[1] == doctest::Approx(30 / wavelength_m).epsilon(1e-12));  // and towards the wall behind it
  config.transmitters[0].velocity_m_s = {0, 30, 0};
  CHECK(std::abs(run(config).paths.doppler_hz[0]) < 1e-9);
  config.transmitters[0].velocity_m_s = {0, 0, 0};
  config.receivers[0].velocity_m_s = {30, 0, 0};
  const Paths receding = run(config).paths;
  CHECK(receding.doppler_hz[0] == doctest::Approx(-30 / wavelength_m).epsilon(1e-12));  // away from the transmitter
  CHECK(receding.doppler_hz[1] == doctest::Approx(30 / wavelength_m).epsilon(1e-12));   // towards the wall
}

TEST_CASE("shifts do not touch anything else; ends that stand still have none") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config = config_of(file.path(), {{1.37, 2.21, 1.55}}, {{6.13, 3.42, 0.87}}, 100000, 2);
  const Paths still = run(config).paths;
  for (const double shift : still.doppler_hz) {
    CHECK(shift == 0);
    CHECK_FALSE(std::signbit(shift));
  }
  config.receivers[0].velocity_m_s = {1, 2, 3};
  Paths moving = run(config).paths;
  CHECK(moving.doppler_hz != still.doppler_hz);
  moving.doppler_hz = still.doppler_hz;
  CHECK(identical(moving, still));
}
