// SPDX-License-Identifier: Apache-2.0
// Air and vegetation: coefficients against tables of the recommendations, chords against closed forms and against
// points that are inside or not, and the loss of a path against A = g d. tests/radio/air_itur.py compares air with
// itur.
#include <random>

#include "radio/air.hpp"
#include "radio/leaves.hpp"
#include "radio/vegetation_law.hpp"
#include "radio/world.hpp"
#include "scene/volumes.hpp"
#include "wavetracer/device/volumes.h"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace test;

namespace {

constexpr double db_of_np = 20 / std::numbers::ln10;

}  // namespace

TEST_CASE("rain: k and alpha of ITU-R P.838-3, Table 5") {
  const auto check = [](double ghz, double k_h, double alpha_h, double k_v, double alpha_v) {
    CAPTURE(ghz);
    const RainCoefficients c = rain_coefficients(ghz);
    CHECK(c.k_h == test::near(k_h, 6e-4));
    CHECK(c.alpha_h == test::near(alpha_h, 6e-5));
    CHECK(c.k_v == test::near(k_v, 6e-4));
    CHECK(c.alpha_v == test::near(alpha_v, 6e-5));
  };
  check(10, 0.01217, 1.2571, 0.01129, 1.2156);
  check(30, 0.2403, 0.9485, 0.2291, 0.9129);
}

TEST_CASE("gases: the lines of oxygen at 60 GHz and of water at 22 GHz; dry air and no air") {
  CHECK(gas_db_km(60, 15, 1013.25, 7.5) > 14);
  CHECK(gas_db_km(60, 15, 1013.25, 7.5) < 16);
  CHECK(gas_db_km(22.235, 15, 1013.25, 7.5) > gas_db_km(19, 15, 1013.25, 7.5) + 0.05);
  CHECK(gas_db_km(22.235, 15, 1013.25, 0) < gas_db_km(22.235, 15, 1013.25, 7.5) / 5);
}

TEST_CASE("what a path loses in rain: level V and H waves, a steep one, and a reflected one leg by leg") {
  const double ghz = 38, rate = 42;
  const RainCoefficients c = rain_coefficients(ghz);
  const auto db_km = [&](double elevation_rad, double cos_2tau) {  // equations 1, 4 and 5
    const double x = std::pow(std::cos(elevation_rad), 2) * cos_2tau;
    const double k = (c.k_h + c.k_v + (c.k_h - c.k_v) * x) / 2;
    const double alpha =
        (c.k_h * c.alpha_h + c.k_v * c.alpha_v + (c.k_h * c.alpha_h - c.k_v * c.alpha_v) * x) / (2 * k);
    return k * std::pow(rate, alpha);
  };
  for (const char* const word : {"V", "H"}) {
    World world(ghz * 1e9);
    const Polarization polarization = Polarization::named(word);
    const double cos_2tau = polarization == "V" ? -1 : 1;
    world.config.transmitters = {World::end({0, 0, 10}, "isotropic", polarization)};
    world.config.receivers = {World::end({3000, 0, 10}, "isotropic", polarization),
                              World::end({600, 0, 810}, "isotropic", polarization)};
    const uint32_t ground = world.add_plane({0, 0, 1}, {0, 0, 0}, test::conductor());
    world.add_reflections(0, 0, {});
    world.add_reflections(0, 0, {ground});
    world.add_reflections(0, 1, {});
    const Paths dry = world.paths();
    world.config.air.rain_mm_h = rate;
    const Paths wet = world.paths();
    REQUIRE(wet.size() == 3);
    const auto lost = [&](size_t row) { return dry.gain_db[row] - wet.gain_db[row]; };
    CHECK(lost(0) == test::near(3 * db_km(0, cos_2tau), 1e-9));
    CHECK(lost(1) == test::near(std::hypot(3, 0.02) * db_km(std::atan2(20, 3000), cos_2tau), 1e-9));
    CHECK(lost(2) == test::near(db_km(std::atan2(800, 600), cos_2tau), 1e-9));
    CHECK(wet.delay_s == dry.delay_s);
  }
}

TEST_CASE("gases and fog take the same of every wave, per metre") {
  World world(60e9);
  world.config.transmitters = {World::end({0, 0, 10}, "isotropic", "VH")};
  world.config.receivers = {World::end({400, 300, 10}, "isotropic", "VH")};
  world.add_reflections(0, 0, {});
  const Paths without = world.paths();
  world.config.air = {.fog_g_m3 = 0.5, .gases = true, .temperature_c = 20, .pressure_hpa = 990, .humidity_g_m3 = 3};
  const Paths with = world.paths();
  const double db = 0.5 * (gas_db_km(60, 20, 990, 3) + 0.5 * fog_db_km(60, 20));
  CHECK(without.gain_db[0] - with.gain_db[0] == test::near(db, 1e-10));
}

TEST_CASE("chords: a ball, a box and a cylinder by closed forms, and ends inside") {
  const auto chord = [](VolumeShape shape, const glm::dvec3& from, const glm::dvec3& to) {
    return inside_m(table_of({shaped(shape, {100, 50, 5}, {3, 3, 3})}), from, to);
  };
  using enum VolumeShape;
  for (const double away : {0.0, 1.0, 2.9, 2.99999})
    CHECK(chord(spheroid, {-1e4, 50 + away, 5}, {1e4, 50 + away, 5}) ==
          test::near(2 * std::sqrt(9 - away * away), 1e-10));
  CHECK(chord(spheroid, {0, 53.0001, 5}, {200, 53.0001, 5}) == 0);
  CHECK(chord(spheroid, {100, 50, 5}, {100, 50, 40}) == test::near(3, 1e-12));
  CHECK(chord(spheroid, {99, 50, 5}, {101, 50, 5}) == test::near(2, 1e-12));
  CHECK(chord(spheroid, {0, 50, 5}, {96, 50, 5}) == 0);
  CHECK(chord(spheroid, {104, 50, 5}, {200, 50, 5}) == 0);
  CHECK(chord(box, {0, 0, 5}, {200, 100, 5}) == test::near(6 * std::sqrt(1.25), 1e-12));
  CHECK(chord(box, {100, 50, -9}, {100, 50, 90}) == test::near(6, 1e-12));
  CHECK(chord(cylinder, {0, 52, 4}, {200, 52, 6}) == test::near(2 * std::sqrt(5.0) * std::hypot(1, 0.01), 1e-12));
  CHECK(chord(cylinder, {97, 50, -100}, {103, 50, 110}) == test::near(6 * std::hypot(1, 6.0 / 210), 1e-12));
}

TEST_CASE("chords of turned volumes by counting points, and of the mesh of a box as of the box") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  using enum VolumeShape;
  int met = 0;
  for (int k = 0; k < 300; ++k) {
    const Volume volume =
        shaped(k % 3 == 0   ? box
               : k % 3 == 1 ? cylinder
                            : spheroid,
               {u(random), u(random), u(random)}, {2 + u(random), 2 + u(random), 3 + u(random)}, 3 * u(random));
    const glm::dvec3 from = 6.0 * glm::dvec3(u(random), u(random), u(random)),
                     to = 6.0 * glm::dvec3(u(random), u(random), u(random));
    const double length = inside_m(table_of({volume}), from, to);
    constexpr int points = 2000;
    int inside = 0;
    for (int i = 0; i < points; ++i) inside += is_inside(volume, from + (to - from) * ((i + 0.5) / points));
    CHECK(std::abs(length - inside * glm::distance(from, to) / points) <= 1.001 * glm::distance(from, to) / points);
    met += inside > 0;
    if (volume.shape != box) continue;
    for (const bool inside_out : {false, true})
      CHECK(std::abs(inside_m(table_of(mesh_volumes(box_mesh(volume, inside_out), 0)), from, to) - length) < 1e-12);
  }
  CHECK(met > 80);
}

TEST_CASE("legs through the edges and corners of a mesh are counted once") {
  const Volume cube = shaped(VolumeShape::box, {0, 0, 0}, {1, 1, 1});
  const VolumeTable mesh = table_of(mesh_volumes(box_mesh(cube), 0));
  // Through corners, along diagonals of faces, through edges, by shared edges of two triangles.
  CHECK(inside_m(mesh, {-3, -3, -3}, {3, 3, 3}) == test::near(2 * std::sqrt(3.0), 1e-12));
  CHECK(inside_m(mesh, {3, -3, 3}, {-3, 3, -3}) == test::near(2 * std::sqrt(3.0), 1e-12));
  CHECK(inside_m(mesh, {-3, -3, 0}, {3, 3, 0}) == test::near(2 * std::sqrt(2.0), 1e-12));
  CHECK(inside_m(mesh, {0, 0, -3}, {0, 0, 3}) == test::near(2, 1e-12));
  CHECK(inside_m(mesh, {0.5, 0.5, 3}, {0.5, 0.5, -3}) == test::near(2, 1e-12));
}

TEST_CASE("meshes of vegetation: parts are volumes of their own, and a mesh with a hole is refused") {
  RawMesh two = box_mesh(shaped(VolumeShape::box, {0, 0, 0}, {1, 1, 1}));
  const RawMesh other = box_mesh(shaped(VolumeShape::box, {10, 0, 0}, {1, 1, 1}), true);
  for (const Triangle& t : other.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  CHECK(mesh_volumes(two, 3).size() == 2);
  CHECK(inside_m(table_of(mesh_volumes(two, 0)), {-5, 0.1, 0.2}, {15, 0.1, 0.2}) == test::near(4, 1e-12));
  two.triangles.pop_back();
  CHECK_THROWS_AS(mesh_volumes(two, 0), InputError);
}

TEST_CASE("vegetation: A_m of the mixed wood of ITU-R P.833-10, Table 1, and its line of specific attenuation") {
  for (const auto& [mhz, db_m, most_db] : std::vector<std::array<double, 3>>{
           {105.9, 0.04, 9.4}, {466.475, 0.12, 18.0}, {949, 0.17, 26.5}, {1852.2, 0.30, 29.0}, {2117.5, 0.34, 34.1}}) {
    CAPTURE(mhz);
    const VegetationLoss loss = vegetation_loss({}, mhz * 1e6);
    CHECK(std::abs(loss.most_db / most_db - 1) < 0.12);         // the law of the recommendation is a fit
    CHECK(std::abs(std::log(loss.db_m / db_m)) < std::log(2));  // Figure 2 is of other woods, too
  }
  VegetationLaw bare;
  bare.in_leaf = false;
  CHECK(vegetation_loss(bare, 1e9).db_m == test::near(0.2 / 1.2, 1e-12));
  CHECK(vegetation_loss(bare, 30e9).db_m == test::near(6 * leafless_share(30e9), 1e-12));
  bare.attenuation_db_m = 1.5;
  CHECK(vegetation_loss(bare, 30e9).db_m == 1.5);
  CHECK(vegetation_loss({.deciduous = true}, 1.8e9).most_db == test::near(0.18 * std::pow(1800, 0.752), 1e-12));
}

TEST_CASE("vegetation without leaves keeps less of its loss the higher the frequency is") {
  // 26.6 f^-0.2 d^0.5 over 15.6 f^-0.009 d^0.26, at 1 m and f in MHz, to four digits.
  for (const auto& [ghz, share] : {std::pair{9.6, 0.2959}, {12.5, 0.2814}, {30.0, 0.2380}, {57.6, 0.2101}})
    CHECK(leafless_share(ghz * 1e9) == test::near(share, 3e-4));
  CHECK(leafless_share(0.1e9) == test::near(1 / 1.2, 1e-15));
  CHECK(leafless_share(1e9) == test::near(1 / 1.2, 1e-15));
  CHECK(leafless_share(100e9) == leafless_share(57.6e9));
  for (const double ghz : {1.0, 9.6, 57.6})  // no steps
    CHECK(leafless_share(ghz * (1 + 1e-9) * 1e9) == test::near(leafless_share(ghz * (1 - 1e-9) * 1e9), 1e-8));
  for (double ghz = 1; ghz < 57; ghz *= 1.1) CHECK(leafless_share(1.1 * ghz * 1e9) < leafless_share(ghz * 1e9));
}

TEST_CASE("what a path loses in vegetation: two kinds, all legs, there as back") {
  World world;
  world.config.transmitters = {World::end({0, 0, 4}), World::end({60, 0, 2})};
  world.config.receivers = {World::end({60, 0, 2}), World::end({0, 0, 4})};
  const uint32_t ground = world.add_plane({0, 0, 1}, {0, 0, 0}, test::medium_dry_ground());
  for (const uint32_t end : {0u, 1u}) {
    world.add_reflections(end, end, {});
    world.add_reflections(end, end, {ground});
  }
  const Paths bare = world.paths();
  VegetationLaw linear{.attenuation_db_m = 1.5, .max_attenuation_db = test::infinity};
  world.scene.materials.push_back({.name = "crown", .vegetation = linear});
  world.scene.materials.push_back({.name = "wood", .vegetation = VegetationLaw{}});
  const auto material = static_cast<uint32_t>(world.scene.materials.size() - 2);
  world.scene.volumes = {shaped(VolumeShape::spheroid, {20, 0, 3}, {2, 2, 2}),
                         shaped(VolumeShape::box, {45, 0, 2.5}, {4, 9, 2.5})};
  world.scene.volumes[0].material = material;
  world.scene.volumes[1].material = material + 1;
  const Paths green = world.paths();
  const VegetationLoss wood = vegetation_loss({}, 5.9e9);
  for (size_t row = 0; row < bare.size(); ++row) {
    std::vector<glm::dvec3> points{row < 2 ? glm::dvec3(0, 0, 4) : glm::dvec3(60, 0, 2)};
    for (size_t k = bare.vertex_offset[row]; k < bare.vertex_offset[row + 1]; ++k)
      points.push_back(bare.vertex_position_m[k]);
    points.push_back(row < 2 ? glm::dvec3(60, 0, 2) : glm::dvec3(0, 0, 4));
    double in_crown = 0, in_wood = 0;
    for (size_t k = 1; k < points.size(); ++k) {
      in_crown += inside_m(table_of({world.scene.volumes[0]}), points[k - 1], points[k]);
      in_wood += inside_m(table_of({world.scene.volumes[1]}), points[k - 1], points[k]);
    }
    CHECK(in_wood > 7.9);
    const double db = 1.5 * in_crown + wood.most_db * (1 - std::exp(-in_wood * wood.db_m / wood.most_db));
    CHECK(bare.gain_db[row] - green.gain_db[row] == test::near(db, 1e-10));
  }
  CHECK(green.gain_db[0] == test::near(green.gain_db[2], 1e-12));
  CHECK(db_of_np > 8);
  world.config.radio.frequency_hz = 2e9;
  CHECK(world.paths().gain_db[0] - green.gain_db[0] > 5);
}

TEST_CASE("more kinds of vegetation than a kernel holds are refused") {
  Scene scene;
  for (uint32_t kind = 0; kind <= WT_MOST_KINDS; ++kind) {
    scene.volumes.push_back(shaped(VolumeShape::box, {0, 0, 0}, {1, 1, 1}));
    scene.volumes.back().material = kind;
  }
  CHECK_THROWS_AS(volume_table(scene), ConfigError);
}
