// SPDX-License-Identifier: Apache-2.0
// The power over the area of a cell: closed forms of two waves, sums over dense points, and statistics of many waves.
#include "coverage/cell_area.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "coverage/made_grid.hpp"

using namespace wavetracer;
using namespace wavetracer::coverage;
using test::MadeGrid;

namespace {

constexpr double pi = std::numbers::pi;

PlaneWave wave(const std::array<std::complex<double>, 4>& field, const glm::dvec2& phase_rad_m) {
  PlaneWave out{field, phase_rad_m, 0};
  for (const auto& port : field) out.power += std::norm(port);
  return out;
}

// Waves of random fields and directions; radius: largest step of the phase in rad/m. ports: 1 or 4.
std::vector<PlaneWave> random_waves(size_t count, double radius, size_t ports, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> turn(0, 2 * pi), share(0.2, 1);
  std::vector<PlaneWave> out;
  for (size_t k = 0; k < count; ++k) {
    std::array<std::complex<double>, 4> field{};
    for (size_t port = 0; port < ports; ++port) field[port] = {normal(random), normal(random)};
    const double angle = turn(random);
    out.push_back(wave(field, radius * share(random) * glm::dvec2(std::cos(angle), std::sin(angle))));
  }
  return out;
}

// Mean and variance over n x n points in the middles of n x n parts of the rectangle.
AreaPower of_points(const std::vector<PlaneWave>& waves, const glm::dvec2& side_m, uint32_t n) {
  double sum = 0, squares = 0;
  for (uint32_t x = 0; x < n; ++x)
    for (uint32_t y = 0; y < n; ++y) {
      const glm::dvec2 at = side_m * (glm::dvec2(x + 0.5, y + 0.5) / double(n) - 0.5);
      double power = 0;
      for (size_t port = 0; port < 4; ++port) {
        std::complex<double> field = 0;
        for (const PlaneWave& each : waves) field += each.field[port] * std::polar(1.0, glm::dot(each.phase_rad_m, at));
        power += std::norm(field);
      }
      sum += power;
      squares += power * power;
    }
  const double count = double(n) * n, mean = sum / count;
  return {mean, squares / count - mean * mean};
}

double sinc_of(double x) { return x == 0 ? 1 : std::sin(x) / x; }

}  // namespace

TEST_CASE("one wave has its power everywhere, and waves of one direction are one wave") {
  const PlaneWave one = wave({std::complex<double>{3, 4}, {0, 0}, {0, 0}, {0, 1}}, {12, -7});
  const AreaPower alone = area_power({one}, {2, 5});
  CHECK(alone.mean == doctest::Approx(26));
  CHECK(alone.variance == doctest::Approx(0).scale(1e-12));
  const AreaPower three = area_power({one, one, one}, {2, 5});
  CHECK(three.mean == doctest::Approx(9 * 26));
  CHECK(three.variance / (three.mean * three.mean) < 1e-24);
}

TEST_CASE("two waves have their closed form, from a part of a wavelength to hundreds") {
  const std::complex<double> a{1, 0.5}, b{-0.3, 0.8};
  for (const double phase : {1e-5, 1e-3, 0.1, 1.0, 3.0, 10.0, 100.0, 1000.0})  // across the cell
    for (const glm::dvec2& way : {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(0.5, 0.7)}) {
      CAPTURE(phase);
      const glm::dvec2 side_m{2, 3}, step = phase * way / side_m;
      const AreaPower power = area_power({wave({a}, {5, 6}), wave({b}, glm::dvec2(5, 6) + step)}, side_m);
      const auto mean_of = [&](double times) {
        return sinc_of(times * phase * way.x / 2) * sinc_of(times * phase * way.y / 2);
      };
      const std::complex<double> product = a * std::conj(b);
      const double s = mean_of(1);
      CHECK(power.mean == doctest::Approx(std::norm(a) + std::norm(b) + 2 * product.real() * s).epsilon(1e-9));
      const double variance =
          2 * std::norm(product) * (1 - s * s) + 2 * (product * product).real() * (mean_of(2) - s * s);
      CHECK(power.variance == doctest::Approx(variance).epsilon(phase <= 3 ? 0.02 : 0.06).scale(1e-14));
    }
}

TEST_CASE("many waves and ports have the mean and variance of dense points") {
  std::mt19937 random(7);
  for (const size_t ports : {1u, 4u})
    for (const double waves_across : {0.3, 1.0, 3.0, 6.0}) {
      CAPTURE(waves_across);
      const glm::dvec2 side_m{2, 1.5};
      const std::vector<PlaneWave> waves = random_waves(12, 2 * pi * waves_across / side_m.x, ports, random);
      const AreaPower power = area_power(waves, side_m), dense = of_points(waves, side_m, 300);
      CHECK(power.mean == doctest::Approx(dense.mean).epsilon(2e-3));
      CHECK(power.variance == doctest::Approx(dense.variance).epsilon(0.06));
    }
}

TEST_CASE("in a cell of many wavelengths powers are added, and phases are as good as random") {
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<PlaneWave> waves = random_waves(8, 2e4, 1, random);
    double sum = 0, squares = 0;
    for (const PlaneWave& each : waves) {
      sum += each.power;
      squares += each.power * each.power;
    }
    const AreaPower power = area_power(waves, {5, 5});
    CHECK(power.mean == doctest::Approx(sum).epsilon(0.01));
    CHECK(power.variance == doctest::Approx(sum * sum - squares).epsilon(0.25));
  }
}

TEST_CASE("beyond a number of waves the weakest add their powers") {
  std::vector<PlaneWave> waves(40, wave({0.01}, {1, 2}));
  waves.insert(waves.end(), most_interfering_waves, wave({std::complex<double>{0, 1}}, {1, 2}));
  waves.insert(waves.end(), 60, wave({0.02}, {1, 2}));
  const double strong = static_cast<double>(most_interfering_waves * most_interfering_waves);
  CHECK(area_power(waves, {1, 1}).mean - strong == doctest::Approx(40 * 1e-4 + 60 * 4e-4).epsilon(1e-4));
}

TEST_CASE("layers of a map are those of the paths from its server, by the directions they come from") {
  MadeGrid made(2, 1, {{0, 0, 20}, {9, 9, 20}});
  struct Path {
    std::complex<double> a;
    double delay_s, theta, phi;
  };
  const std::vector<Path> paths = {
      {{1e-4, 2e-5}, 1e-7, 1.2, 0.3}, {{-6e-5, 1e-5}, 1.3e-7, 1.9, -2.0}, {{3e-5, 0}, 2e-7, 1.5, 1.4}};
  for (const Path& path : paths) {
    made.add(0, 0, path.a, path.delay_s, 1);
    made.frame.paths.aoa_theta_rad.back() = path.theta;
    made.frame.paths.aoa_phi_rad.back() = path.phi;
  }
  made.add(1, 0, 1e-6, 1e-7, 0);  // it is weaker
  const SavedRun run = made.written();
  ReceiverGridConfig grid;
  grid.name = "g";
  grid.step_m = 0.1;
  RadioConfig radio;
  radio.frequency_hz = test::made_carrier_hz;
  Map map = coverage_map(run, radio, run.frame(0), test::links_of(run), grid, {});
  CHECK(std::isnan(map.cells[1].cell_mean_db));
  CHECK(std::isnan(map.cells[1].fading_db));
  map.cells.resize(1);  // its cells lie 10 m apart in x, and 0.1 m in y
  constexpr int n = 400;
  const double turn = 2 * pi * test::made_carrier_hz / 299792458;
  double mean = 0;
  for (int x = 0; x < 10 * n; ++x)
    for (int y = 0; y < n / 20; ++y) {
      const glm::dvec3 at{10 * ((x + 0.5) / (10 * n) - 0.5), 0.1 * ((y + 0.5) / (n / 20.0) - 0.5), 0};
      std::complex<double> field = 0;
      for (const auto& [a, delay_s, theta, phi] : paths) {
        const glm::dvec3 from{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
        field += a * std::polar(1.0, turn * (glm::dot(from, at) - 299792458 * delay_s));
      }
      mean += std::norm(field) / (10 * n * (n / 20));
    }
  CHECK(map.step_m.x == 10);
  CHECK(map.step_m.y == 0.1);
  CHECK(map.cells[0].cell_mean_db == doctest::Approx(10 * std::log10(mean)).epsilon(1e-5));
  CHECK(map.cells[0].fading_db > -20);
}

TEST_CASE("a map says how much of the power is not in the paths that are left, and plots need not have the layers") {
  MadeGrid made(1, 1, {{0, 0, 20}});
  made.add(0, 0, 1e-4, 1e-7, 0);
  const SavedRun run = made.written();
  std::vector<LinkRow> links = test::links_of(run);
  ReceiverGridConfig grid;
  grid.name = "g";
  CHECK(coverage_map(run, {}, run.frame(0), links, grid, {}).notes.empty());
  links.back().left_out_power_share = 0.25;
  const Map map = coverage_map(run, {}, run.frame(0), links, grid, {});
  REQUIRE(map.notes.size() == 1);
  CHECK(map.notes[0].find("up to 25% of the power of a cell") != std::string::npos);
  CHECK(map.cells[0].cell_mean_db == doctest::Approx(-80));
  CHECK(map.cells[0].fading_db == -INFINITY);
  const Map without = coverage_map(run, {}, run.frame(0), links, grid, {.tx = {}, .layers = {}, .areas = false});
  CHECK(without.notes.empty());
  CHECK(without.layers.size() + 2 == map.layers.size());
  CHECK(coverage_map(run, {}, run.frame(0), links, grid, {.tx = {}, .layers = {"paths"}}).notes.empty());
  CHECK_FALSE(std::isnan(
      coverage_map(run, {}, run.frame(0), links, grid, {.tx = {}, .layers = {"fading_db"}}).cells[0].cell_mean_db));
}
