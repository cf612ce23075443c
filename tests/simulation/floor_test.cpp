// SPDX-License-Identifier: Apache-2.0
// Beams down to a gain instead of a depth (trace.floor_db): every path above it is found, whatever its number of
// reflections, and the power of the beams that are not followed is bounded.
#include <algorithm>

#include "simulation/buildings.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

double wavelength_m(const Config& config) { return speed_of_light / config.radio.frequency_hz; }

// The gain of a path of this length that loses nothing at mirrors, between isotropic antennas.
double gain_db(double length_m, const Config& config) {
  return 20 * std::log10(wavelength_m(config) / (4 * std::acos(-1.0) * length_m));
}

Config down_to(Config config, double floor_db) {
  config.trace.discovery = "beams";
  config.trace.floor_db = floor_db;
  config.trace.max_depth = 64;
  return config;
}

std::vector<double> lengths_to(const Paths& paths, uint32_t rx) {
  std::vector<double> out;
  for (size_t i = 0; i < paths.size(); ++i)
    if (paths.rx[i] == rx) out.push_back(paths.delay_s[i] * speed_of_light);
  std::ranges::sort(out);
  return out;
}

// The number of lengths that have no counterpart in `found`, which is sorted, to 1e-9.
size_t count_missing(const std::vector<double>& expected, const std::vector<double>& found) {
  size_t missing = 0;
  for (const double length : expected) {
    const auto at = std::ranges::lower_bound(found, length * (1 - 1e-9));
    missing += at == found.end() || *at > length * (1 + 1e-9);
  }
  return missing;
}

// The larger of the power gains from one polarisation to another, as both antennas have two.
double best_gain_db(const Paths& paths, size_t row) {
  double power = 0;
  for (const std::complex<double>& a : paths.a[row]) power = std::max(power, std::norm(a));
  return 10 * std::log10(power);
}

}  // namespace

TEST_CASE("a box of metal: all images within the reach of a floor, at any depth") {
  const glm::dvec3 size{8, 5, 3}, tx{1.37, 2.21, 1.55};
  const Points receivers{{6.13, 3.42, 0.87}, {2.9, 0.61, 2.6}};
  const SceneFile file(reference::box_walls({0, 0, 0}, size));
  const double reach_m = 24;
  Config config = config_of(file.path(), {tx}, receivers, 1000, 5);
  const FrameResult frame = run(down_to(config, gain_db(reach_m, config)));
  const int order = 16;  // images of more reflections are farther: 3 m, the height, each
  for (uint32_t rx = 0; rx < receivers.size(); ++rx) {
    CAPTURE(rx);
    std::vector<double> expected;
    for (int i = -order; i <= order; ++i)
      for (int j = -order; j <= order; ++j)
        for (int k = -order; k <= order; ++k)
          expected.push_back(glm::distance(
              glm::dvec3(image(tx.x, size.x, i), image(tx.y, size.y, j), image(tx.z, size.z, k)), receivers[rx]));
    std::ranges::sort(expected);
    const std::vector<double> found = lengths_to(frame.paths, rx);
    CHECK(count_missing(found, expected) == 0);  // none is invented
    std::erase_if(expected, [&](double length) { return length > reach_m; });
    CHECK(expected.size() > 400);
    CHECK(count_missing(expected, found) == 0);
  }
  CHECK(duplicates(frame.paths) == 0);
  const Certificate& told = frame.certificate;
  CHECK(told.any_depth);
  CHECK(told.floor_db == gain_db(reach_m, config));
  // All that a lossless room receives is too weak at last, and the bound of its solid angle is not much more.
  CHECK(told.weak_share() + told.left_out_share() >= 1);
  CHECK(told.weak_share() < 1.3);
  CHECK(told.left_out_power <= told.left_out_share());
}

TEST_CASE("two walls of metal: paths of more than sixty reflections") {
  const SceneFile file(
      std::vector<Quad>{{{0, -300, -300}, {0, 600, 0}, {0, 0, 600}}, {{3, -300, -300}, {0, 600, 0}, {0, 0, 600}}});
  Config config = config_of(file.path(), {{1.1, 0, 0}}, {{1.7, 3.5, 1.3}}, 1000, 5);
  const Paths paths = run(down_to(config, gain_db(185, config))).paths;
  std::vector<double> expected;
  for (int k = -63; k <= 63; ++k)
    expected.push_back(glm::distance(glm::dvec3(image(1.1, 3, k), 0, 0), {1.7, 3.5, 1.3}));
  std::erase_if(expected, [](double length) { return length > 185; });
  CHECK(expected.size() > 121);
  CHECK(count_missing(expected, lengths_to(paths, 0)) == 0);
  CHECK(std::ranges::max(paths.depth) > 60);
}

TEST_CASE("houses of concrete and glass: no path above the floor is missing, and weak ones are not followed") {
  std::vector<Quad> walls = building({-12, -3, 0}, 0.2, 9, 7, 8);
  for (const Quad& quad : building({6, -6, 0}, -0.3, 7, 12, 6)) walls.push_back(quad);
  walls.push_back({{-60, -60, 0}, {120, 0, 0}, {0, 120, 0}});
  const SceneFile file({Part{walls, "concrete"}, Part{building({-4, 9, 0}, 0.5, 12, 6, 9), "glass"}});
  Config config =
      config_of(file.path(), {{1.3, 1.1, 2.2}}, {{-1.7, 5.3, 1.4}, {3.1, -9.7, 1.8}, {14.9, 12.3, 5.1}}, 1000, 7);
  config.trace.discovery = "beams";
  const FrameResult all = run(config);
  for (const double floor_db : {-75.0, -90.0, -110.0}) {
    CAPTURE(floor_db);
    const FrameResult some = run(down_to(config, floor_db));
    size_t above = 0, lost = 0;
    for (size_t row = 0; row < all.paths.size(); ++row) {
      if (best_gain_db(all.paths, row) < floor_db) continue;
      ++above;
      const double length = all.paths.delay_s[row] * speed_of_light;
      lost += count_missing({length}, lengths_to(some.paths, all.paths.rx[row]));
    }
    CHECK(above > 3);
    CHECK(lost == 0);
    CHECK(some.certificate.any_depth);
    CHECK(some.certificate.weak_share() > 0);
    CHECK(some.certificate.weak_share() < 1);
  }
  CHECK(run(down_to(config, -75)).counts.sequences < all.counts.sequences / 4);
}

TEST_CASE("many ends in a closed room: the bound of what is weak is that of all of them together") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  const Points ends{{1.37, 2.21, 1.55}, {6.13, 3.42, 0.87}, {2.9, 0.61, 2.6}, {4.4, 4.1, 1.9}};
  Config config = config_of(file.path(), ends, {{7.1, 1.3, 2.2}}, 1000, 5);
  const Certificate told = run(down_to(config, gain_db(10, config))).certificate;
  CHECK(told.ends == 4);
  CHECK(told.weak_share() >= 1);
  CHECK(told.weak_share() < 2);
}

TEST_CASE("a world without receivers, or a floor above all paths: nothing is followed, and all is told") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config = config_of(file.path(), {{1.37, 2.21, 1.55}}, {{6.13, 3.42, 0.87}}, 1000, 5);
  const FrameResult frame = run(down_to(config, -20));
  CHECK(frame.counts.sequences == 0);
  CHECK(frame.paths.size() == 1);  // the direct one is always found
  CHECK(frame.certificate.any_depth);
  CHECK(frame.certificate.weak_share() >= 1);
}
