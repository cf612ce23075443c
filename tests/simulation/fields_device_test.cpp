// SPDX-License-Identifier: Apache-2.0
// Compares the fields of a frame on the device with the same code on the host: every column, to the last bit, with
// everything that a path can meet: walls, edges, rough surfaces, vehicles, and antennas of every kind.
#include <map>
#include <tuple>

#include "radio/fields.hpp"
#include "simulation/frame.hpp"
#include "simulation/town.hpp"
#include "simulation/visible_paths.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Number = std::tuple<double, double, double, double, double, double, double>;

struct Columns {
  Number numbers;
  std::array<std::complex<double>, 4> a;
  std::vector<uint32_t> surfaces, instances;
  std::vector<uint8_t> interactions;
  std::vector<glm::dvec3> points;
  bool operator==(const Columns&) const = default;
};

Columns row_of(const Paths& p, size_t i) {
  Columns out{{p.delay_s[i], p.gain_db[i], p.doppler_hz[i], p.aod_theta_rad[i], p.aod_phi_rad[i], p.aoa_theta_rad[i],
               p.aoa_phi_rad[i]},
              p.a[i],
              {},
              {},
              {},
              {}};
  for (size_t k = p.vertex_offset[i]; k < p.vertex_offset[i + 1]; ++k) {
    out.surfaces.push_back(p.vertex_surface[k]);
    out.instances.push_back(p.vertex_instance[k]);
    out.interactions.push_back(p.vertex_interaction[k]);
    out.points.push_back(p.vertex_position_m[k]);
  }
  return out;
}

// Frames 0 and 1; returns how many interactions of which kind they have.
std::map<uint8_t, size_t> check_same(const Config& config, uint32_t frames) {
  Setup s = make_setup(config, "");
  FrameLoop loop(s);
  Config all = s.plan->asked;
  all.trace = s.plan->trace;
  const FieldModel host(s.plan->scene, all, s.plan->world.fleet.models, s.plan->world.fleet.instances);
  std::map<uint8_t, size_t> kinds;
  for (uint32_t frame = 0; frame < frames; ++frame) {
    const FrameResult found = loop.run(FrameTask::of_drive(
        {.frame = frame, .pose = [&] { return s.plan->world.state(frame); }, .names = FrameNames::none()}));
    Paths expected = host.compute(frame, read_visible(s), found.world);
    name_targets(expected, s.plan->world.targets);
    CHECK(found.paths.size() > 50);
    CHECK(found.paths.size() <= expected.size());
    std::multimap<std::tuple<uint32_t, uint32_t, double>, size_t> by_delay;
    for (size_t i = 0; i < expected.size(); ++i)
      by_delay.emplace(std::tuple(expected.tx[i], expected.rx[i], expected.delay_s[i]), i);
    size_t same = 0;
    for (size_t i = 0; i < found.paths.size(); ++i) {
      const Columns row = row_of(found.paths, i);
      const auto [first, last] = by_delay.equal_range({found.paths.tx[i], found.paths.rx[i], found.paths.delay_s[i]});
      same += std::any_of(first, last, [&](const auto& entry) { return row_of(expected, entry.second) == row; });
      for (const uint8_t kind : row.interactions) ++kinds[kind];
    }
    CHECK(same == found.paths.size());
  }
  return kinds;
}

Config town(uint64_t rays, uint32_t max_depth) {
  Config config = small_town(rays, max_depth);
  const std::array antennas{"short-dipole", "dipole", "tr38901", "isotropic", "dipole"};
  const auto polarizations = std::to_array<Polarization>({"V", "cross", "VH", "H", "VH"});
  for (size_t i = 0; i < config.receivers.size(); ++i) {
    config.receivers[i].antenna = antennas[i];
    config.receivers[i].polarization = polarizations[i];
    config.receivers[i].orientation_deg = {30.0 * static_cast<double>(i), 10, -20};
    config.receivers[i].velocity_m_s = {3, -14, 0.5};
  }
  return config;
}

}  // namespace

TEST_CASE("fields on the device are the host's to the last bit: reflections, walls that are passed, edges") {
  Config config = town(20000, 3);
  config.trace.diffraction = true;
  config.trace.transmission = true;
  auto kinds = check_same(config, 1);
  CHECK(kinds[reflection] > 100);
  CHECK(kinds[transmission] > 10);
  CHECK(kinds[diffraction] > 100);
}

TEST_CASE("fields on the device are the host's to the last bit: two edges") {
  Config config = town(2000, 2);
  config.trace.diffraction = true;
  config.trace.max_diffractions = 2;
  CHECK(check_same(config, 1)[diffraction] > 200);
}

TEST_CASE("fields on the device are the host's to the last bit: rough surfaces") {
  Config config = town(2000, 2);
  config.trace.scattering = true;
  config.trace.tile_m = 8;
  config.materials.emplace_back();
  config.materials[0].name = "concrete";
  config.materials[0].scattering = 0.3;
  config.materials[0].scattering_lobe = 4;
  config.materials[0].scattering_cross_polar = 0.2;
  CHECK(check_same(config, 1)[scattering] > 200);
  config.trace.scattering_reflections = 2;
  config.trace.max_depth = 3;
  auto kinds = check_same(config, 1);
  CHECK(kinds[scattering] > 1000);
  CHECK(kinds[reflection] > 1000);
}

TEST_CASE("fields on the device are the host's to the last bit: targets") {
  Config config = town(20000, 4);
  config.trace.transmission = true;
  config.trace.target_reflections = 2;
  config.target_models = {{.name = "car", .on = "", .kind = "vehicle-points"}};
  config.targets = {{.name = "a",
                     .model = "car",
                     .position_m = {3, -2, 0},
                     .orientation_deg = {33, 4, -2},
                     .velocity_m_s = {4, 9, 1}}};
  auto kinds = check_same(config, 1);
  CHECK(kinds[target_point] > 100);
  CHECK(kinds[reflection] > 100);
}

TEST_CASE("fields on the device are the host's to the last bit: bodies of vehicles that are targets") {
  Config config = town(20000, 3);
  let_vehicles_hear(config);
  config.trace.target_reflections = 1;
  TargetModelConfig body;
  body.name = "body";
  body.on = "*";
  body.kind = "body";
  body.piece_m = 2;
  config.target_models = {body};
  auto kinds = check_same(config, 2);
  CHECK(kinds[target_point] > 300);
  CHECK(kinds[reflection] > 300);
}

TEST_CASE("fields on the device are the host's to the last bit: behind crowns, several of one kind") {
  Config config = town(50000, 3);
  for (int i = 0; i < 6; ++i) {
    VegetationConfig& crown = config.vegetation.emplace_back();
    crown.centre_m = {-60.0 + 23 * i, 4.0 - 2 * i, 5};
    crown.size_m = {9, 8, 9};
    crown.material = i % 2 ? "vegetation" : "deciduous_vegetation";
  }
  for (const char* name : {"vegetation", "deciduous_vegetation"}) {
    MaterialConfig& leaves = config.materials.emplace_back();
    leaves.name = name;
    leaves.vegetation = "mixed";
  }
  check_same(config, 1);
}

TEST_CASE("fields on the device are the host's to the last bit: several crowns of one kind that scatter") {
  Config config = town(2000, 2);
  config.trace.scattering = true;
  config.trace.transmission = true;
  for (int i = 0; i < 6; ++i) {
    VegetationConfig& crown = config.vegetation.emplace_back();
    crown.centre_m = {-60.0 + 23 * i, 4.0 - 2 * i, 5};
    crown.size_m = {5, 5, 6};
    crown.material = i % 2 ? "vegetation" : "deciduous_vegetation";
  }
  for (const char* name : {"vegetation", "deciduous_vegetation"}) {
    MaterialConfig& leaves = config.materials.emplace_back();
    leaves.name = name;
    leaves.vegetation = "mixed";
    leaves.scattering = 0.6;
    leaves.scattering_cross_polar = 0.3;
  }
  config.trace.tile_m = 2;
  CHECK(check_same(config, 1)[scattering] > 50);
}

TEST_CASE("fields on the device are the host's to the last bit: vehicles that drive, with Doppler shifts") {
  Config config = town(50000, 3);
  let_vehicles_hear(config);
  config.trace.diffraction = true;
  CHECK(check_same(config, 2)[diffraction] > 100);
}
