// SPDX-License-Identifier: Apache-2.0
// Tests air and vegetation from the configuration to paths: rays continue through leaves, fields lose what the laws
// say, the device computes the same as the host, and a scene without either neither runs nor compiles any of it.
#include <limits>
#include <map>

#include "radio/vegetation_law.hpp"
#include "simulation/run.hpp"
#include "wavetracer/device/volumes.h"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A street: ground, two walls, and a block with edges in it.
SceneFile street() {
  return SceneFile(
      std::vector<Part>{{{{{-30, -8, 0}, {60, 0, 0}, {0, 16, 0}}}, "concrete"},
                        {{{{-30, 8, 0}, {60, 0, 0}, {0, 0, 12}}, {{-30, -8, 0}, {60, 0, 0}, {0, 0, 12}}}, "glass"},
                        {{{{0, -3, 0}, {0, 6, 0}, {0, 0, 4}}}, "metal"}});
}

Config street_config(const SceneFile& scene) {
  Config config = config_of(scene.path(), {{-12, 1.3, 5}}, {{11, -2.1, 1.5}, {5, 6, 2}}, 50000, 3);
  config.trace.diffraction = true;
  config.trace.transmission = true;
  return config;
}

std::vector<VegetationConfig> trees() {
  VegetationConfig crown, hedge;
  crown.centre_m = {-5, 2, 4};
  crown.size_m = {5, 5, 6};
  hedge.shape = "box";
  hedge.centre_m = {7, 0, 1};
  hedge.size_m = {1, 15, 2};
  hedge.yaw_deg = 10;
  hedge.material = "deciduous_vegetation";
  return {crown, hedge};
}

double in_kind(const Scene& scene, const VolumeTable& table, uint32_t kind, const Paths& paths, size_t row,
               const Config& config) {
  const auto at = [&](const std::array<double, 3>& p) { return glm::dvec3(p[0], p[1], p[2]); };
  std::vector<glm::dvec3> points{at(config.transmitters[paths.tx[row]].position_m)};
  for (size_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k)
    points.push_back(paths.vertex_position_m[k]);
  points.push_back(at(config.receivers[paths.rx[row]].position_m));
  double out = 0;
  for (size_t k = 1; k < points.size(); ++k)
    for (const device::wt_volume& volume : table.volumes)
      if (volume.kind == kind)
        out += device::wt_length_inside(&volume, table.triangles.data(), points[k - 1] - scene.origin_m,
                                        points[k] - scene.origin_m);
  return out;
}

}  // namespace

TEST_CASE("vegetation: the same paths, each weaker by what its legs pass, whatever their interactions") {
  const SceneFile file = street();
  Config config = street_config(file);
  const Paths bare = run(config).paths;
  config.vegetation = trees();
  config.radio.frequencies_hz = {5.9e9, 28e9};
  const Simulation simulation(config);
  Simulation running(config);
  const FrameResult green = running.run_frame(0);
  REQUIRE(green.paths.size() == bare.size());
  CHECK(green.paths.delay_s == bare.delay_s);
  CHECK(green.paths.vertex_surface == bare.vertex_surface);
  const Scene& scene = running.scene();
  const VolumeTable table = volume_table(scene);
  CHECK(table.material.size() == 2);
  std::map<uint8_t, size_t> weaker;  // paths by their interactions
  for (size_t row = 0; row < bare.size(); ++row) {
    double at_5_9 = 0;
    for (uint32_t kind = 0; kind < 2; ++kind) {
      const VegetationLoss loss = vegetation_loss(*scene.materials[table.material[kind]].vegetation, 5.9e9);
      const double d = in_kind(scene, table, kind, bare, row, config);
      at_5_9 += loss.most_db * (1 - std::exp(-d * loss.db_m / loss.most_db));
    }
    CHECK(std::abs(bare.gain_db[row] - green.paths.gain_db[row] - at_5_9) < 1e-8);
    if (at_5_9 == 0) continue;
    CHECK(green.carriers.at(0).gain_db[row] < green.paths.gain_db[row]);
    uint8_t kinds = 0;
    for (size_t k = bare.vertex_offset[row]; k < bare.vertex_offset[row + 1]; ++k) kinds |= bare.vertex_interaction[k];
    ++weaker[kinds];
  }
  CHECK(weaker.size() >= 3);  // reflected, transmitted and diffracted ones among them
  CHECK(simulation.features().at("vegetation").on);
}

TEST_CASE("vegetation and rain: reciprocal") {
  const SceneFile file = street();
  Config config = street_config(file);
  config.receivers.resize(1);
  config.vegetation = trees();
  config.air.rain_mm_h = 60;
  const Paths there = run(config).paths;
  std::swap(config.transmitters, config.receivers);
  const Paths back = run(config).paths;
  REQUIRE(there.size() == back.size());
  REQUIRE(there.size() > 5);
  for (size_t row = 0; row < there.size(); ++row) {
    const auto match =
        std::ranges::min_element(back.delay_s, {}, [&](double delay) { return std::abs(delay - there.delay_s[row]); });
    const auto other = static_cast<size_t>(match - back.delay_s.begin());
    CHECK(std::abs(there.gain_db[row] - back.gain_db[other]) < 1e-7);
  }
}

TEST_CASE("a scene without vegetation and air has no such pass, and the same fields as ever") {
  const SceneFile file = street();
  const Config config = street_config(file);
  Simulation simulation(config);
  simulation.profile_every(1);
  const FrameResult frame = simulation.run_frame(0);
  CHECK_FALSE(simulation.features().at("vegetation").on);
  CHECK(simulation.features().at("vegetation").reason == "the scene has no volume of vegetation");
  CHECK_FALSE(simulation.features().at("air").on);
  for (const auto& [kernel, time] : frame.kernels) CHECK(kernel.find("vegetation") == std::string::npos);
  CHECK(frame.seconds.count("vegetation") == 0);
}

TEST_CASE("closed meshes whose material is vegetation are volumes, and no surfaces") {
  const std::vector<Quad> hedge{{{4, -6, 0}, {1, 0, 0}, {0, 12, 0}}, {{4, -6, 2}, {0, 12, 0}, {1, 0, 0}},
                                {{4, -6, 0}, {0, 0, 2}, {1, 0, 0}},  {{4, 6, 0}, {1, 0, 0}, {0, 0, 2}},
                                {{4, -6, 0}, {0, 12, 0}, {0, 0, 2}}, {{5, -6, 0}, {0, 0, 2}, {0, 12, 0}}};
  const SceneFile file(std::vector<Part>{{{{{-30, -8, 0}, {60, 0, 0}, {0, 16, 0}}}, "concrete"}, {hedge, "leaves"}});
  Config config = config_of(file.path(), {{-3, 0.1, 1.1}}, {{11, 0.3, 1.1}}, 20000, 2);
  MaterialConfig leaves;
  leaves.name = "leaves";
  leaves.permittivity = 1;
  config.materials = {leaves};
  const FrameResult solid = run(config);
  config.materials[0].permittivity.reset();
  config.materials[0].vegetation = "mixed";
  config.materials[0].attenuation_db_m = 2;
  config.materials[0].max_attenuation_db = std::numeric_limits<double>::infinity();
  const FrameResult green = run(config);
  CHECK(green.paths.size() == 2);
  config.materials[0].attenuation_db_m = 0;
  const FrameResult nothing = run(config);
  CHECK(solid.paths.size() < green.paths.size());
  const double through = std::hypot(14, 0.2) / 14;  // 1 m of the line of sight, which goes a little to the side
  CHECK(std::abs(nothing.paths.gain_db[0] - green.paths.gain_db[0] - 2 * through) < 1e-9);
  config.materials[0].permittivity = 3;
  CHECK_THROWS_AS(run(config), ConfigError);
}
