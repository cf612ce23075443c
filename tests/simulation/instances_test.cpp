// SPDX-License-Identifier: Apache-2.0
// Compares vehicles as instances with the same vehicles baked into one static scene at the same poses, and with all
// paths that exist (brute force); tests vehicles that come and go, paths that a vehicle blocks, and what its own
// antenna sees.
#include "reference/brute_force.hpp"
#include "scene/load.hpp"
#include "simulation/drive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

const Points street_transmitters{{-31.3, 2.17, 4.1}, {12.4, -7.3, 0.9}};

// Scattered over the street, low enough to be seen in the sides of vehicles.
const Points street_receivers = [] {
  Points out;
  for (int i = 0; i < 24; ++i)
    out.push_back({-40.3 + 3.71 * i, -8.2 + std::fmod(5.37 * i, 16.0), 0.4 + std::fmod(0.83 * i, 2.5)});
  return out;
}();

// The truck appears at 1 s, one car vanishes at 2.5 s.
const std::vector<Straight> vehicles{{"ego", "passenger", {-20.3, -3.1, 0}, {9.7, 0.4, 0}, 0, 4},
                                     {"other", "passenger", {30.7, 3.9, 0.02}, {-11.3, 0.7, 0}, 0, 2.5},
                                     {"truck", "truck", {19.6, 7.1, 0.01}, {-7.9, -1.3, 0}, 1, 4}};

Config drive(const std::filesystem::path& scene, uint32_t max_depth, uint64_t rays = 1000000) {
  Config config = config_of(scene, street_transmitters, street_receivers, rays, max_depth);
  config.trace.reuse = false;
  add_vehicles(config, vehicles, 1);
  return config;
}

bool present(const Straight& vehicle, double time_s) { return vehicle.start_s <= time_s && time_s <= vehicle.end_s; }

MeshFile baked(double time_s) {
  std::vector<Mesh> meshes;
  for (const Part& part : street()) meshes.push_back(mesh_of(part));
  for (const Straight& vehicle : vehicles)
    if (present(vehicle, time_s)) meshes.push_back(mesh_of(vehicle, time_s));
  return MeshFile(meshes);
}

double difference(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

void check_same(const Paths& a, const Paths& b) {
  CHECK(a.size() == b.size());
  const std::vector<uint32_t> other = counterparts(a, b);
  CHECK(std::count(other.begin(), other.end(), no_row) == 0);
  CHECK(missing(b, a) == 0);
  double worst_a = 0, worst_gain_db = 0, worst_angle_rad = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const uint32_t j = other[i];
    if (j == no_row) continue;
    double size = 0, error = 0;
    for (size_t port = 0; port < 4; ++port) {
      size += std::norm(a.a[i][port]);
      error += std::norm(a.a[i][port] - b.a[j][port]);
    }
    worst_a = std::max(worst_a, std::sqrt(error / size));
    worst_gain_db = std::max(worst_gain_db, std::abs(a.gain_db[i] - b.gain_db[j]));
    worst_angle_rad =
        std::max({worst_angle_rad, difference(a.aod_theta_rad[i], b.aod_theta_rad[j]),
                  difference(a.aod_phi_rad[i], b.aod_phi_rad[j]), difference(a.aoa_theta_rad[i], b.aoa_theta_rad[j]),
                  difference(a.aoa_phi_rad[i], b.aoa_phi_rad[j])});
  }
  CHECK(worst_a < 1e-9);
  CHECK(worst_gain_db < 1e-8);  // 1e-9 of the power
  CHECK(worst_angle_rad < 1e-9);
}

}  // namespace

TEST_CASE("a drive gives, frame by frame, the paths of the same vehicles baked into the scene") {
  const SceneFile file(street());
  Simulation moving(drive(file.path(), 3));
  REQUIRE(moving.frame_count() == 5);
  size_t by_vehicles = 0;
  for (uint32_t frame = 0; frame < 5; ++frame) {
    CAPTURE(frame);
    const FrameResult result = moving.run_frame(frame);
    const MeshFile still = baked(frame);
    check_same(result.paths, run(config_of(still.path(), street_transmitters, street_receivers, 1000000, 3)).paths);
    by_vehicles += paths_by_vehicles(result.paths);
  }
  CHECK(by_vehicles > 200);
}

TEST_CASE("every depth: the paths of a drive are all that there are") {
  const SceneFile file(street());
  const MeshFile still = baked(2);
  Config load;
  load.scene.file = still.path().string();
  const Scene scene = load_scene(load);
  Points tx, rx;
  for (const glm::dvec3& p : street_transmitters) tx.push_back(p - scene.origin_m);
  for (const glm::dvec3& p : street_receivers) rx.push_back(p - scene.origin_m);
  const PathGeometry all = reference::brute_force_paths(scene, tx, rx, 3);
  for (const uint32_t max_depth : {0u, 1u, 2u, 3u}) {
    CAPTURE(max_depth);
    const Paths found = Simulation(drive(file.path(), max_depth, 4000000)).run_frame(2).paths;
    std::vector<std::pair<std::array<uint32_t, 3>, double>> expected, got;
    for (size_t i = 0; i < all.size(); ++i) {
      const auto depth = static_cast<uint32_t>(all.first[i + 1] - all.first[i]);
      if (depth <= max_depth)
        expected.push_back(
            {{all.tx[i], all.rx[i], depth}, reference::path_length_m(all, i, tx[all.tx[i]], rx[all.rx[i]])});
    }
    for (size_t i = 0; i < found.size(); ++i)
      got.push_back({{found.tx[i], found.rx[i], found.depth[i]}, found.delay_s[i] * speed_of_light});
    std::sort(expected.begin(), expected.end());
    std::sort(got.begin(), got.end());
    REQUIRE(got.size() == expected.size());
    for (size_t i = 0; i < got.size(); ++i) {
      CHECK(got[i].first == expected[i].first);
      CHECK(got[i].second == doctest::Approx(expected[i].second).epsilon(1e-12));
    }
  }
}

TEST_CASE("vehicles that are not there reflect nothing and hide nothing") {
  const SceneFile file(street());
  Simulation moving(drive(file.path(), 2, 200000));
  std::vector<size_t> all_paths_by(vehicles.size(), 0);
  for (uint32_t frame = 0; frame < 5; ++frame) {
    CAPTURE(frame);
    const FrameResult result = moving.run_frame(frame);
    std::vector<size_t> paths_by(vehicles.size(), 0);
    for (const uint32_t instance : result.paths.vertex_instance)
      if (instance != no_instance) ++paths_by[instance];
    for (size_t i = 0; i < vehicles.size(); ++i) {
      const auto vehicle = std::find_if(vehicles.begin(), vehicles.end(),
                                        [&](const Straight& v) { return v.id == moving.instances()[i].id; });
      CAPTURE(vehicle->id);
      CHECK(result.world.instances[i].present == present(*vehicle, frame));
      if (!present(*vehicle, frame)) CHECK(paths_by[i] == 0);
      all_paths_by[i] += paths_by[i];
    }
  }
  for (const size_t count : all_paths_by) CHECK(count > 3);
}

TEST_CASE("a truck hides one car's antenna from the other's, except through the gap behind its cab") {
  const SceneFile file(std::vector<Part>{{{{{-60, -60, 0}, {120, 0, 0}, {0, 120, 0}}}, "concrete"}});
  Config config = config_of(file.path(), {}, {}, 100, 0);
  // It crosses the line of sight, along x at y = 0 and 1.6 m high, with 10 m/s.
  add_vehicles(config,
               {{"a", "passenger", {-20, 0.3, 0}, {0.01, 0, 0}, 0, 2},
                {"b", "passenger", {20, -0.2, 0}, {0.01, 0, 0}, 0, 2},
                {"truck", "truck", {0, -10, 0}, {0, 10, 0}, 0, 2}},
               0.013);
  config.mounts = {{.name = "roof", .on = "passenger", .role = "both", .offset_m = {0, 0, 1.6}}};
  config.trace.reuse = false;
  Simulation moving(config);
  size_t hidden = 0, through_gap = 0;
  for (uint32_t frame = 0; frame < moving.frame_count(); ++frame) {
    const double time_s = moving.time_s(frame), y = -10 + 10 * time_s;
    // The line of sight meets the truck there, in its axes: both ends move along x in the same way.
    const double ahead = 0.05 - y;
    if (std::abs(ahead - 1.8) < 0.1 || std::abs(ahead - 2.25) < 0.1 || std::abs(std::abs(ahead) - 4.5) < 0.1) continue;
    CAPTURE(ahead);
    const bool gap = ahead > 1.8 && ahead < 2.25, expected = gap || std::abs(ahead) > 4.5;
    CHECK(moving.run_frame(frame).paths.size() == (expected ? 2 : 0));  // line of sight in both directions
    hidden += !expected;
    through_gap += gap;
  }
  CHECK(hidden > 50);
  CHECK(through_gap > 0);
}

TEST_CASE("an antenna inside its own vehicle's body sees what it sees without the body") {
  const SceneFile file(street());
  Config config = config_of(file.path(), {}, {{40, 6, 5}, {-55, -10, 6}, {3, -9, 4.5}}, 300000, 1);
  add_vehicles(config, {{"ego", "passenger", {-3, 1.3, 0}, {8, 0.3, 0}, 0, 2}}, 0.5);
  config.mounts = {{.name = "inside", .role = "both", .offset_m = {0.3, 0.1, 0.9}}};
  config.transmitters = {{.name = "mast", .position_m = {20, -8, 6}}};
  config.trace.reuse = false;
  Config bodiless = config;
  bodiless.vehicle_types[0].model = "none";
  Simulation with(config), without(bodiless);
  REQUIRE(with.instances().size() == 1);
  REQUIRE(without.instances().empty());
  for (uint32_t frame = 0; frame < with.frame_count(); ++frame) {
    CAPTURE(frame);
    const Paths a = with.run_frame(frame).paths, b = without.run_frame(frame).paths;
    CHECK(missing(b, a) == 0);
    CHECK(b.size() > 12);
    // The body adds its reflections of the mast's field to the fixed receivers.
    for (size_t i = 0; i < a.size(); ++i) {
      const bool own = a.tx[i] == 1 || a.rx[i] == 3;
      if (own && a.depth[i] == 1) CHECK(a.vertex_instance[a.vertex_offset[i]] == no_instance);
    }
  }
}
