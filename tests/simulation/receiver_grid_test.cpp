// SPDX-License-Identifier: Apache-2.0
// Tests grids of receivers: their places, counted by hand, and their gains, against closed forms.
// Scenes are plates that the tests write; antennas are isotropic.
#include "simulation/receiver_grid.hpp"

#include <fmt/format.h>

#include <complex>
#include <numbers>
#include <set>

#include "simulation/run.hpp"
#include "simulation/world.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double pi = std::numbers::pi;

Scene box_scene() {
  Scene scene;
  scene.origin_m = {1000, 2000, 50};
  scene.lower = {-30, -20, 0};
  scene.upper = {30, 20, 10};
  return scene;
}

ReceiverGridConfig grid_of(double x_min, double x_max, double y_min, double y_max, double step) {
  ReceiverGridConfig grid;
  grid.name = "g";
  grid.x_min_m = x_min;
  grid.x_max_m = x_max;
  grid.y_min_m = y_min;
  grid.y_max_m = y_max;
  grid.step_m = step;
  return grid;
}

GridShape shape_of(const ReceiverGridConfig& grid) {
  const Config config;
  const Scene scene = box_scene();
  PlaceFinder places(config, scene);
  return grid_shape(grid, scene, places);
}

std::vector<RadioEnd> receivers_of(const ReceiverGridConfig& grid, const Scene& scene) {
  Config config;
  config.receiver_grids = {grid};
  PlaceFinder places(config, scene);
  return standing_receivers(config, scene, places);
}

std::string error_of(const Config& config, const Scene& scene) {
  PlaceFinder places(config, scene);
  try {
    standing_receivers(config, scene, places);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

// Sums of |a|^2 of each receiver.
std::vector<double> powers(const FrameResult& frame) {
  std::vector<double> out(frame.world.receivers.size(), 0);
  for (size_t i = 0; i < frame.paths.size(); ++i) out[frame.paths.rx[i]] += std::norm(frame.paths.a[i][0]);
  return out;
}

Config coverage_of(const SceneFile& file, const glm::dvec3& tx, const ReceiverGridConfig& grid) {
  Config config = config_of(file.path(), {tx}, {}, 100000, 2);
  config.transmitters[0].polarization = "V";
  config.receiver_grids = {grid};
  return config;
}

double wavelength_m(const Config& config) { return speed_of_light / config.radio.frequency_hz; }

}  // namespace

TEST_CASE("cells fill the borders from their middle, row by row, x first") {
  ReceiverGridConfig grid = grid_of(0, 10, -3, 3, 3);
  grid.height_m = 1.5;
  grid.antenna = "dipole";
  grid.polarization = "VH";
  const GridShape shape = shape_of(grid);
  CHECK(shape.columns == 3);
  CHECK(shape.rows == 2);
  CHECK(shape.x_m == 2);  // 9 m of 10: half a metre is left at either side
  CHECK(shape.y_m == -1.5);
  const std::vector<RadioEnd> ends = receivers_of(grid, box_scene());
  REQUIRE(ends.size() == 6);
  const char* names[] = {"g/0,0", "g/1,0", "g/2,0", "g/0,1", "g/1,1", "g/2,1"};
  for (size_t i = 0; i < 6; ++i) {
    CHECK(ends[i].name == names[i]);
    CHECK(ends[i].position_m == std::array<double, 3>{2.0 + 3.0 * static_cast<double>(i % 3), i < 3 ? -1.5 : 1.5, 1.5});
    CHECK(ends[i].antenna == "dipole");
    CHECK(ends[i].polarization.word() == "VH");
  }
  CHECK(shape_of(grid_of(0, 0.3, 0, 0.1, 0.1)).columns == 3);  // not 2 for want of a last bit
  CHECK(shape_of(grid_of(0, 100, 7, 7, 1)).rows == 1);
  CHECK(shape_of(grid_of(0, 100, 7, 7, 1)).y_m == 7);
}

TEST_CASE("borders that are not given are those of the scene, in the coordinates of its file") {
  ReceiverGridConfig grid;
  grid.name = "all";
  grid.step_m = 10;
  const std::vector<RadioEnd> ends = receivers_of(grid, box_scene());
  REQUIRE(ends.size() == 6 * 4);
  CHECK(ends.front().position_m == std::array<double, 3>{975, 1985, 1.5});
  CHECK(ends.back().position_m == std::array<double, 3>{1025, 2015, 1.5});
}

TEST_CASE("cells of a vertical plane stand along it, row by row upwards") {
  ReceiverGridConfig grid;
  grid.name = "g";
  grid.from_m = {100, 50};
  grid.to_m = {106.6, 58.8};  // 11 m in the direction (0.6, 0.8)
  grid.z_min_m = 1;
  grid.z_max_m = 6;
  grid.step_m = 2;
  const GridShape shape = shape_of(grid);
  CHECK(shape.columns == 5);  // 10 m of 11, and 4 m of 5: half a metre is left at every side
  CHECK(shape.rows == 2);
  const std::vector<RadioEnd> ends = receivers_of(grid, box_scene());
  REQUIRE(ends.size() == 10);
  for (uint32_t k = 0; k < 10; ++k) {
    CHECK(ends[k].name == fmt::format("g/{},{}", k % 5, k / 5));
    const double along = 1.5 + 2 * (k % 5);
    CHECK(ends[k].position_m[0] == doctest::Approx(100 + 0.6 * along).epsilon(1e-12));
    CHECK(ends[k].position_m[1] == doctest::Approx(50 + 0.8 * along).epsilon(1e-12));
    CHECK(ends[k].position_m[2] == (k < 5 ? 2.5 : 4.5));
  }
  grid.z_min_m.reset();
  grid.z_max_m.reset();
  CHECK(receivers_of(grid, box_scene()).front().position_m[2] == 51);  // the scene goes from 50 to 60 m
  CHECK(receivers_of(grid, box_scene()).back().position_m[2] == 59);
  grid.z_max_m = 7;
  grid.z_min_m = 7;
  CHECK(shape_of(grid).rows == 1);
  CHECK(receivers_of(grid, box_scene()).front().position_m[2] == 7);
}

TEST_CASE("what cannot be a vertical plane says which and why") {
  Config config;
  ReceiverGridConfig& grid = config.receiver_grids.emplace_back();
  grid.name = "g";
  grid.from_m = {0, 0};
  const auto said = [&](const char* part) { return error_of(config, box_scene()).find(part) != std::string::npos; };
  CHECK(said("\"g\": a vertical plane stands between from_m and to_m: give both"));
  grid.to_m = {0, 0};
  CHECK(said("give both, at different places"));
  grid.to_m = {30, 40};
  grid.z_min_m = 70;
  CHECK(said("\"g\": z_max_m = 60 is below z_min_m = 70 (not given, they are those of the scene): exchange"));
  grid.z_min_m = 0;
  grid.step_m = 0.01;
  CHECK(said("30000000 receivers in all grids, and 20000000 are the limit"));
  grid = {};
  grid.heights_m = {1, 2};
  CHECK(said("heights_m is a key of configuration files"));
}

TEST_CASE("names lead back to cells") {
  const auto cell = grid_cell("a/b", "a/b/12,305");
  REQUIRE(cell.has_value());
  CHECK(cell->ix == 12);
  CHECK(cell->iy == 305);
  for (const char* other : {"a/b", "a/b/", "a/b/1", "a/b/1,", "a/b/,1", "a/b/1,2,3", "a/b/-1,2", "a/b/1,2 ", "a/c/1,2",
                            "a/b/99999999999,1", "x"})
    CHECK_FALSE(grid_cell("a/b", other).has_value());
}

TEST_CASE("what cannot be a grid says which and why") {
  Config config;
  config.receiver_grids = {grid_of(10, 0, 0, 1, 1)};
  CHECK(error_of(config, box_scene()).find("\"g\": x_max_m = 0 is below x_min_m = 10") != std::string::npos);
  config.receiver_grids = {grid_of(0, 5000, 0, 4001, 1)};
  CHECK(error_of(config, box_scene()).find("20005000 receivers in all grids, and 20000000 are the limit") !=
        std::string::npos);
  config.receiver_grids = {grid_of(0, 1000, 0, 1000, 1e-300)};
  CHECK(error_of(config, box_scene()).find("are the limit") != std::string::npos);
  config.receiver_grids = {grid_of(0, 1, 0, 1, 1), grid_of(0, 5000, 0, 4000, 1)};
  config.receiver_grids[1].name = "h";
  CHECK(error_of(config, box_scene()).find("\"h\": its cells of 1 m make 20000001 receivers") != std::string::npos);
  config.receiver_grids = {grid_of(0, 1, 0, 1, 1), grid_of(5, 6, 0, 1, 1)};
  CHECK(error_of(config, box_scene()).find("a radio end of the name \"g/0,0\" exists already") != std::string::npos);
  config.receiver_grids.pop_back();
  config.receivers = {{.name = "g/0,0"}};
  CHECK(error_of(config, box_scene()).find("exists already") != std::string::npos);
}

TEST_CASE("grids stand behind the receivers of the configuration, and the world has them") {
  const SceneFile file({{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}});
  Config config = config_of(file.path(), {{0, 0, 10}}, {{1, 2, 3}}, 1000, 1);
  config.receiver_grids = {grid_of(0, 2, 0, 2, 1)};
  const Simulation simulation(config);
  REQUIRE(simulation.config().receivers.size() == 5);
  CHECK(simulation.config().receivers[0].name == "rx0");
  CHECK(simulation.config().receivers[4].name == "g/1,1");
}

TEST_CASE("a grid follows the stations, and takes none of their names") {
  Config config;
  config.stations.resize(1);
  config.stations[0].name = "rsu";
  config.receiver_grids = {grid_of(0, 2, 0, 1, 1)};
  const Scene scene = box_scene();
  PlaceFinder places(config, scene);
  const std::vector<RadioEnd> ends = standing_receivers(config, scene, places);
  REQUIRE(ends.size() == 3);
  CHECK(ends[0].name == "rsu");
  CHECK(ends[1].name == "g/0,0");
  config.stations[0].name = "g/1,0";
  CHECK(error_of(config, box_scene()).find("\"g/1,0\" exists already") != std::string::npos);
}

TEST_CASE("above the ground: the lowest surface at each place, a slope here, with a roof over a part of it") {
  // z = x / 10 + 5 over 100 x 100 m, and a plate 20 m above it.
  const SceneFile file({{{0, 0, 5}, {100, 0, 10}, {0, 100, 0}}, {{40, 40, 30}, {20, 0, 0}, {0, 20, 0}}});
  Config config = config_of(file.path(), {{50, 50, 60}}, {}, 1000, 1);
  ReceiverGridConfig grid = grid_of(-20, 120, 0, 100, 10);
  grid.above = "ground";
  grid.height_m = 2;
  config.receiver_grids = {grid};
  const Simulation simulation(config);
  const std::vector<RadioEnd>& ends = simulation.config().receivers;
  REQUIRE(ends.size() == 14 * 10);
  for (const RadioEnd& end : ends) {
    const double x = end.position_m[0];
    CAPTURE(end.name);
    CHECK(end.position_m[2] == doctest::Approx(x > 0 && x < 100 ? 5 + x / 10 + 2 : 7).epsilon(1e-12));
  }
}

TEST_CASE("nothing but a far plate: every receiver of the grid hears Friis' equation") {
  const SceneFile file({{{-5, -5, -1000}, {10, 0, 0}, {0, 10, 0}}});
  const glm::dvec3 tx{3.3, -4.1, 25};
  Config config = coverage_of(file, tx, grid_of(-150, 150, -100, 100, 5));
  config.trace.max_depth = 0;
  const FrameResult frame = run(config);
  const std::vector<double> heard = powers(frame);
  REQUIRE(heard.size() == 60 * 40);
  double worst = 0;
  for (size_t i = 0; i < heard.size(); ++i) {
    const glm::dvec3 rx{-147.5 + 5.0 * static_cast<double>(i % 60), -97.5 + 5.0 * static_cast<double>(i / 60), 1.5};
    const double friis = std::pow(wavelength_m(config) / (4 * pi * glm::distance(tx, rx)), 2);
    worst = std::max(worst, std::abs(heard[i] / friis - 1));
  }
  CHECK(worst < 1e-9);
}

TEST_CASE("two rays over a ground plane, along a line of 900 receivers") {
  const SceneFile file({Part{{{{-2000, -2000, 0}, {4000, 0, 0}, {0, 4000, 0}}}, "concrete"}});
  const glm::dvec3 tx{0, 0, 20};
  Config config = coverage_of(file, tx, grid_of(10, 910, 0, 0, 1));
  MaterialConfig& ground = config.materials.emplace_back();
  ground.name = "concrete";
  ground.permittivity = 5.31;
  ground.conductivity_s_m = 0.05;
  ground.thickness_m = INFINITY;
  const std::vector<double> heard = powers(run(config));
  REQUIRE(heard.size() == 900);
  const double lambda = wavelength_m(config);
  constexpr double vacuum_permittivity = 8.8541878128e-12;
  const std::complex<double> eta{5.31, -0.05 / (2 * pi * config.radio.frequency_hz * vacuum_permittivity)};
  double worst = 0;
  for (size_t i = 0; i < heard.size(); ++i) {
    const double d = 10.5 + static_cast<double>(i), direct = std::hypot(d, tx.z - 1.5),
                 mirrored = std::hypot(d, tx.z + 1.5);
    const double cosine = (tx.z + 1.5) / mirrored, sine = d / mirrored;
    const std::complex<double> root = std::sqrt(eta - sine * sine);
    const std::complex<double> vertical = (eta * cosine - root) / (eta * cosine + root);
    const double closed =
        std::pow(lambda / (4 * pi), 2) * (1 / (direct * direct) + std::norm(vertical) / (mirrored * mirrored));
    worst = std::max(worst, std::abs(heard[i] / closed - 1));
  }
  CHECK(worst < 1e-9);
}

TEST_CASE("receivers inside of a closed box keep their place in the grid, without a path") {
  std::vector<reference::Quad> quads = reference::box_walls({-10, -10, 0}, {10, 10, 10});
  quads.push_back({{-200, -200, 0}, {400, 0, 0}, {0, 400, 0}});
  const SceneFile file(quads);
  const FrameResult frame = run(coverage_of(file, {50, 3, 30}, grid_of(-40, 40, -40, 40, 4)));
  const std::vector<double> heard = powers(frame);
  REQUIRE(heard.size() == 400);
  CHECK(frame.world.links.size() == 400);
  for (size_t i = 0; i < heard.size(); ++i) {
    const double x = -38 + 4.0 * static_cast<double>(i % 20), y = -38 + 4.0 * static_cast<double>(i / 20);
    CAPTURE(x);
    CAPTURE(y);
    if (std::abs(x) < 10 && std::abs(y) < 10) CHECK(heard[i] == 0);
    if (x > 10) CHECK(heard[i] > 0);
  }
}
