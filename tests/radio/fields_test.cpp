// SPDX-License-Identifier: Apache-2.0
// Coefficients, delays and angles against Friis, the two-ray ground and transmission through a wall; instances against
// the same surfaces standing still. Isotropic antennas and 5.9 GHz unless a test says otherwise.
#include "radio/fields.hpp"

#include <doctest/doctest.h>

#include "radio/antenna.hpp"
#include "radio/material.hpp"
#include "radio/slab.hpp"
#include "radio/surface_table.hpp"
#include "radio/world.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using test::World;

namespace {

double friis(const World& world, double length_m) { return world.wavelength_m() / (4 * std::numbers::pi * length_m); }

World two_ray(const Material& ground, Polarization polarization, double distance_m) {
  World world;
  const uint32_t plane = world.add_plane({0, 0, 1}, {0, 0, 0}, ground);
  world.config.transmitters = {World::end({0, 0, 1.5}, "isotropic", polarization)};
  world.config.receivers = {World::end({distance_m, 0, 1.5}, "isotropic", polarization)};
  world.add_reflections(0, 0, {});
  world.add_reflections(0, 0, {plane});
  return world;
}

}  // namespace

TEST_CASE("Friis: free space between every pair of antennas, broadside") {
  const std::vector<std::pair<std::string, double>> antennas{
      {"isotropic", 1}, {"short-dipole", 1.5}, {"dipole", 1.6409223769845852}, {"tr38901", std::pow(10, 0.8)}};
  for (const auto& [sent, sent_gain] : antennas) {
    for (const auto& [heard, heard_gain] : antennas) {
      CAPTURE(sent);
      CAPTURE(heard);
      World world;
      world.config.transmitters = {World::end({10, 20, 1.5}, sent)};
      world.config.receivers = {World::end({110, 20, 1.5}, heard, "V", {180, 0, 0})};
      world.add_reflections(0, 0, {});
      const Paths paths = world.paths();
      REQUIRE(paths.size() == 1);
      CHECK(std::abs(paths.a[0][0]) == test::near(friis(world, 100) * std::sqrt(sent_gain * heard_gain), 1e-12));
      CHECK(paths.gain_db[0] == test::near(20 * std::log10(std::abs(paths.a[0][0])), 1e-13));
      CHECK(paths.delay_s[0] == test::near(100 / 299792458.0, 1e-15));
      CHECK(paths.doppler_hz[0] == 0);
    }
  }
}

TEST_CASE("line of sight: ports, signs, angles, rows") {
  World world;
  world.scene.origin_m = {690000, 5330000, 500};
  world.config.transmitters = {World::end({690000, 5330000, 510}, "isotropic", "VH")};
  world.config.receivers = {World::end({690003, 5330004, 510}, "isotropic", "VH"),
                            World::end({690000, 5330000, 500}, "isotropic", "V")};
  world.add_reflections(0, 1, {});
  world.add_reflections(0, 0, {});
  const Paths paths = compute_paths(world.scene, world.config, 7, world.geometry);
  REQUIRE(paths.size() == 2);
  CHECK(paths.rx_ports == 2);
  CHECK(paths.tx_ports == 2);
  CHECK(paths.frame == std::vector<uint32_t>{7, 7});
  CHECK(paths.rx == std::vector<uint32_t>{0, 1});  // sorted, though found the other way round
  CHECK(paths.depth == std::vector<uint32_t>{0, 0});
  CHECK(paths.vertex_offset == std::vector<uint64_t>{0, 0, 0});

  const double a = friis(world, 5);
  CHECK(std::abs(paths.a[0][0] - a) < 1e-15);
  CHECK(std::abs(paths.a[0][1]) + std::abs(paths.a[0][2]) < 1e-17);
  CHECK(std::abs(paths.a[0][3] + a) < 1e-15);  // phi-hat is reversed, seen from the receiver
  CHECK(paths.gain_db[0] == test::near(10 * std::log10(2 * a * a), 1e-12));
  CHECK(paths.aod_theta_rad[0] == test::near(std::numbers::pi / 2, 1e-15));
  CHECK(paths.aod_phi_rad[0] == test::near(std::atan2(4, 3), 1e-9));
  CHECK(paths.aoa_phi_rad[0] == test::near(std::atan2(-4, -3), 1e-9));

  // Straight down: both ends look along a pole; the single port of the receiver fills one row of the matrix.
  CHECK(paths.aod_theta_rad[1] == test::near(std::numbers::pi, 1e-15));
  CHECK(paths.aoa_theta_rad[1] == 0);
  CHECK(paths.aoa_phi_rad[1] == 0);
  CHECK(std::abs(paths.a[1][0]) == test::near(friis(world, 10), 1e-12));
  CHECK(paths.a[1][2] == 0.0);
  CHECK(paths.a[1][3] == 0.0);
}

TEST_CASE("a single receiver port beside two transmitter ports fills one row of two") {
  World world;
  world.config.transmitters = {World::end({0, 0, 0}, "isotropic", "VH")};
  world.config.receivers = {World::end({5, 0, 0}, "isotropic", "H")};
  world.add_reflections(0, 0, {});
  const Paths paths = world.paths();
  CHECK(paths.rx_ports == 1);
  CHECK(paths.tx_ports == 2);
  CHECK(std::abs(paths.a[0][0]) < 1e-17);
  CHECK(std::abs(paths.a[0][1] + friis(world, 5)) < 1e-15);
}

// Over a perfect conductor the coefficient of a horizontal field is -1 at every angle, which is the -1 of the
// textbook's two-ray model. conductor() is within 1e-12 of it, and the values are printed to 1e-4 dB.
TEST_CASE("two-ray ground: perfect conductor, horizontal polarisation") {
  const std::vector<std::pair<double, double>> known{
      {10, -63.2575}, {100, -90.9089}, {500, -101.3683}, {1000, -113.0687}};
  for (const auto& [distance_m, gain_db] : known) {
    CAPTURE(distance_m);
    CHECK(std::abs(two_ray(test::conductor(), "H", distance_m).narrowband_gain_db() - gain_db) < 6e-5);
  }
}

TEST_CASE("two-ray ground: medium-dry ground, vertical polarisation") {
  CHECK(std::abs(two_ray(test::medium_dry_ground(), "V", 100).narrowband_gain_db() - -91.2969) < 6e-5);
}

TEST_CASE("a ground reflection has the Fresnel coefficient, its angles and its vertex in file coordinates") {
  World world = two_ray(test::concrete(0.1), "VH", 20);
  const SlabCoefficients slab = slab_coefficients(complex_permittivity(test::concrete(0.1), 5.9e9),
                                                  1.5 / std::hypot(10, 1.5), 0.1, world.wavelength_m());
  const Paths paths = world.paths();
  REQUIRE(paths.size() == 2);
  const double a = friis(world, 2 * std::hypot(10, 1.5));
  CHECK(std::abs(paths.a[1][0] - a * slab.reflection_tm) < 1e-15);
  CHECK(std::abs(paths.a[1][3] + a * slab.reflection_te) < 1e-15);
  CHECK(std::abs(paths.a[1][1]) + std::abs(paths.a[1][2]) < 1e-17);
  const double down = std::numbers::pi / 2 + std::atan2(1.5, 10);
  CHECK(paths.aod_theta_rad[1] == test::near(down, 1e-14));
  CHECK(paths.aoa_theta_rad[1] == test::near(down, 1e-14));
  CHECK(std::abs(paths.aoa_phi_rad[1]) == test::near(std::numbers::pi, 1e-14));
  CHECK(paths.depth[1] == 1);
  CHECK(paths.vertex_offset == std::vector<uint64_t>{0, 0, 1});
  CHECK(glm::length(paths.vertex_position_m[0] - glm::dvec3{10, 0, 0}) < 1e-12);
  CHECK(paths.vertex_interaction[0] == reflection);
  CHECK(paths.vertex_surface[0] == 0);
  CHECK(paths.vertex_instance[0] == no_instance);
}

TEST_CASE("transmission goes straight through and takes the slab's coefficient") {
  World world;
  const uint32_t wall = world.add_plane({1, 0, 0}, {2, 0, 0}, test::concrete(0.1));
  world.config.transmitters = {World::end({0, 0, 0}, "isotropic", "VH")};
  world.config.receivers = {World::end({4, 3, 0}, "isotropic", "VH")};
  world.add_path(0, 0, {wall}, {transmission}, {{2, 1.5, 0}});
  const SlabCoefficients slab =
      slab_coefficients(complex_permittivity(test::concrete(0.1), 5.9e9), 0.8, 0.1, world.wavelength_m());
  const Paths paths = world.paths();
  CHECK(std::abs(paths.a[0][0] - friis(world, 5) * slab.transmission_te) < 1e-15);  // V is normal to the plane z = 0
  CHECK(std::abs(paths.a[0][3] + friis(world, 5) * slab.transmission_tm) < 1e-15);
  CHECK(paths.delay_s[0] == test::near(5 / speed_of_light_m_s, 1e-15));
}

TEST_CASE("a corner met in its very edge: the leg of no length takes its direction from the law of reflection") {
  World world;
  const uint32_t x = world.add_plane({1, 0, 0}, {0, 0, 0}, test::conductor());
  const uint32_t y = world.add_plane({0, 1, 0}, {0, 0, 0}, test::conductor());
  world.config.transmitters = {World::end({1, 2, 0}, "isotropic", "VH")};
  world.config.receivers = {World::end({2, 4, 0}, "isotropic", "VH")};
  world.add_path(0, 0, {x, y}, {reflection, reflection}, {{0, 0, 0}, {0, 0, 0}});
  const Paths paths = world.paths();
  CHECK(paths.gain_db[0] == test::near(10 * std::log10(2 * std::pow(friis(world, 3 * std::sqrt(5)), 2)), 1e-9));
  CHECK(paths.aoa_phi_rad[0] == test::near(std::atan2(-4, -2), 1e-12));
}

TEST_CASE("lengths keep nine digits over 14 km of UTM coordinates") {
  World world;
  world.scene.origin_m = {691000, 5334000, 520};
  const glm::dvec3 tx{684000, 5334000, 521.5}, rx{698000, 5334000, 521.5};
  const uint32_t plane = world.add_plane({0, 0, 1}, {0, 0, 0}, test::concrete(0.1));
  world.config.transmitters = {World::end(tx)};
  world.config.receivers = {World::end(rx)};
  world.add_reflections(0, 0, {plane});
  // 2 sqrt(7000^2 + 1.5^2)
  CHECK(world.paths().delay_s[0] * speed_of_light_m_s == test::near(14000.000321428567, 1e-14));
}

TEST_CASE("an antenna within 0.1 mm of a mirror or of the other antenna: those paths are left out and counted") {
  World world;
  const uint32_t ground = world.add_plane({0, 0, 1}, {0, 0, 0}, test::concrete(0.1));
  const uint32_t wall = world.add_plane({0, 1, 0}, {0, 5, 0}, test::concrete(0.1));
  world.config.transmitters = {World::end({1, 1, 9e-5}), World::end({1, 1, 1.1e-4})};
  world.config.receivers = {World::end({4, 2, 1.5}), World::end({1, 1, 1.5e-4})};
  for (const uint32_t tx : {0u, 1u})
    for (const uint32_t rx : {0u, 1u})
      for (const auto& surfaces : std::vector<std::vector<uint32_t>>{{}, {ground}, {wall}, {ground, wall}})
        world.add_reflections(tx, rx, surfaces);
  const FieldModel model(world.scene, world.config);
  WorldState state;
  for (const RadioEnd& end : world.config.transmitters)
    state.transmitters.push_back({.position_m = {end.position_m[0], end.position_m[1], end.position_m[2]}});
  for (const RadioEnd& end : world.config.receivers)
    state.receivers.push_back({.position_m = {end.position_m[0], end.position_m[1], end.position_m[2]}});
  LeftOut left_out;
  const Paths paths = model.compute(0, world.geometry, state, &left_out);
  // The lower transmitter loses what the ground reflects first, and the line of sight to the receiver 0.06 mm above it;
  // the upper one loses the line of sight to that receiver.
  CHECK(left_out == LeftOut{{{0, 0}, 2}, {{0, 1}, 3}, {{1, 1}, 1}});
  CHECK(paths.size() == world.geometry.size() - 6);
  for (const double gain_db : paths.gain_db) CHECK(std::isfinite(gain_db));
  const auto name = [](uint32_t end) { return "end" + std::to_string(end); };
  CHECK(left_out_warning(left_out, name, name) ==
        "6 paths are left out, because an antenna is at most 0.0001 m away from the surface that reflects there, "
        "or from the other antenna: \"end0\" -> \"end0\" (2), \"end0\" -> \"end1\" (3), \"end1\" -> \"end1\" (1); "
        "move the antenna");
}

TEST_CASE("what cannot be computed is an error") {
  World scattered;
  const uint32_t plane = scattered.add_plane({0, 0, 1}, {0, 0, 0}, test::concrete(0.1));
  scattered.config.transmitters = {World::end({0, 0, 1})};
  scattered.config.receivers = {World::end({1, 0, 1})};
  scattered.add_path(0, 0, {plane}, {scattering}, {{0.5, 0, 0}});
  CHECK_THROWS_AS(scattered.paths(), RuntimeError);

  World low(0.5e9);
  low.add_plane({0, 0, 1}, {0, 0, 0}, test::concrete(0.1));
  CHECK_THROWS_AS(low.paths(), ConfigError);
  low.scene.surfaces.clear();  // the same material, used by no surface
  CHECK_NOTHROW(low.paths());
}

TEST_CASE("an antenna that is blind in the direction of a path gives -inf, not NaN") {
  World world;
  world.config.transmitters = {World::end({0, 0, 10}, "short-dipole")};
  world.config.receivers = {World::end({0, 0, 0})};
  world.add_reflections(0, 0, {});
  CHECK(world.paths().gain_db[0] < -300);
}

namespace {

// A model with a concrete plane z = 2 and a conducting plane x = 1, in its own axes, beside a static ground z = 0.
struct InstanceWorld : World {
  std::vector<Scene> models;
  std::vector<Instance> instances;
  WorldState state;

  InstanceWorld() {
    add_plane({0, 0, 1}, {0, 0, 0}, test::medium_dry_ground());
    World model;
    model.add_plane({0, 0, 1}, {0, 0, 2}, test::concrete(0.1));
    model.add_plane({1, 0, 0}, {1, 0, 0}, test::conductor());
    models = {model.scene};
    instances = {{"first", "car", 0, 1}, {"second", "car", 0, 3}};
    state.instances = {{}, {{10, 20, 30}, rotation_of({90, 0, 0}), {1, 2, 3}, {0, 0, 0.5}}};
    config.transmitters = {end({0, 0, 5}, "tr38901", "VH", {20, 10, 0})};
    config.receivers = {end({8, 1, 6}, "dipole", "cross", {-40, 5, 70})};
    const auto state_of = [&](const RadioEnd& e) { return EndState{place(e), rotation_of(e.orientation_deg)}; };
    state.transmitters = {state_of(config.transmitters[0])};
    state.receivers = {state_of(config.receivers[0])};
  }

  Paths moving_paths() const { return FieldModel(scene, config, models, instances).compute(0, geometry, state); }
};

}  // namespace

TEST_CASE("surfaces of instances: numbers, normals, velocities of their material points") {
  const InstanceWorld world;
  const SurfaceTable table(world.scene, world.models, world.instances);
  const WorldPlace ground = table.at(0), side = table.at(4);
  CHECK(ground.instance == no_instance);
  CHECK(ground.index == 0);
  CHECK(table.at(2).instance == 0);
  CHECK(side.instance == 1);
  CHECK(side.index == 1);
  CHECK(table.scene(side.part).materials[table.surface(side).material] == test::conductor());
  CHECK_THROWS_AS(table.at(5), std::out_of_range);
  CHECK(table.normal(ground, world.state) == glm::dvec3{0, 0, 1});
  CHECK(glm::length(table.normal(side, world.state) - glm::dvec3{0, 1, 0}) < 1e-15);  // turned by a right angle
}

TEST_CASE("a surface of an instance reflects as the same surface of a static scene does") {
  InstanceWorld world;
  world.state.instances[1] = {{3, -20, 4}, rotation_of({25, 70, 10})};
  const glm::dvec3 normal = world.state.instances[1].rotation * glm::dvec3{0, 0, 1};
  World still = world;
  const uint32_t plane = still.add_plane(normal, glm::dvec3{3, -20, 4} + 2.0 * normal, test::concrete(0.1));
  still.add_reflections(0, 0, {0, plane});
  still.add_reflections(0, 0, {plane});
  world.geometry = still.geometry;
  for (uint32_t& surface : world.geometry.surface)
    if (surface == plane) surface = 3;
  const Paths expected = still.paths(), paths = world.moving_paths();
  REQUIRE(paths.size() == 2);
  CHECK(paths.delay_s == expected.delay_s);
  for (size_t i = 0; i < 2; ++i) {
    CHECK(paths.gain_db[i] > -200);
    for (size_t port = 0; port < 4; ++port) CHECK(std::abs(paths.a[i][port] - expected.a[i][port]) < 1e-15);
  }
  const size_t single = paths.depth[0] == 1 ? 0 : 1;
  CHECK(paths.vertex_surface[paths.vertex_offset[single]] == 0);  // the first of its model
  CHECK(paths.vertex_instance[paths.vertex_offset[single]] == 1);
  CHECK(paths.vertex_surface[paths.vertex_offset[1 - single]] == 0);  // the ground
  CHECK(paths.vertex_instance[paths.vertex_offset[1 - single]] == no_instance);
}

TEST_CASE("ends are where the state has them, turned as it says, to the last bit") {
  World still;
  still.config.transmitters = {World::end({3, 4, 5}, "tr38901", "VH", {30, -20, 10})};
  still.config.receivers = {World::end({9, 2, 1}, "dipole", "cross", {-50, 15, 75})};
  still.add_reflections(0, 0, {});
  World elsewhere = still;
  elsewhere.config.transmitters[0] = World::end({-7, 1, 1}, "tr38901", "VH", {0, 0, 0});
  elsewhere.config.receivers[0] = World::end({70, 1, 1}, "dipole", "cross", {5, 5, 5});
  WorldState state;
  state.transmitters = {{{3, 4, 5}, rotation_of({30, -20, 10}), {30, 0, 0}}};
  state.receivers = {{{9, 2, 1}, rotation_of({-50, 15, 75}), {0, -20, 0}}};
  const Paths expected = still.paths();
  const Paths paths = FieldModel(elsewhere.scene, elsewhere.config).compute(0, elsewhere.geometry, state);
  CHECK(paths.a == expected.a);
  CHECK(paths.delay_s == expected.delay_s);
  CHECK(paths.gain_db == expected.gain_db);
  CHECK(paths.aoa_phi_rad == expected.aoa_phi_rad);
  // 6, -2 and -4 m are the leg's components, sqrt(56) m its length: the ends approach by these parts of their speeds.
  CHECK(paths.doppler_hz[0] == test::near((30 * 6 - 20 * 2) / std::sqrt(56) / still.wavelength_m(), 1e-13));
}

TEST_CASE("a model's material that is not known at the frequency is an error") {
  InstanceWorld world;
  world.scene = {};
  world.config.radio.frequency_hz = 0.5e9;
  CHECK_THROWS_AS(FieldModel(world.scene, world.config, world.models, world.instances), ConfigError);
}
