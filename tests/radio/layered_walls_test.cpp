// SPDX-License-Identifier: Apache-2.0
// Walls of layers in a scene: the side that a wave meets, edges, scattering, bounds, opacity and ranges.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "radio/fields.hpp"
#include "radio/material.hpp"
#include "radio/material_table.hpp"
#include "radio/opacity.hpp"
#include "radio/reflectance_bounds.hpp"
#include "radio/slab.hpp"
#include "radio/world.hpp"
#include "wavetracer/device/scattering.h"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using Complex = std::complex<double>;

namespace {

constexpr double hz = 5.9e9;

// Wood in front of a sheet of metal: its two sides differ by much.
Material clad() {
  Material wood{"wood", 1.99, 0, 0.0047, 1.0718, 0.001, 100, 0.03}, metal{"metal", 1, 0, 1e7, 0, 1, 100, 0.001};
  Material out = wood;
  out.name = "clad";
  out.thickness_m = 0.031;
  out.layers = {wood, metal};
  return out;
}

// Concrete in front of an insulation and plasterboard, which lets waves pass.
Material insulated() {
  Material out = test::concrete(0.1);
  out.name = "insulated";
  out.layers = {test::concrete(0.08),
                {"foam", 1.1, 0, 0.001, 0, 0, test::infinity, 0.1},
                {"plasterboard", 2.73, 0, 0.0085, 0.9395, 1, 100, 0.0125}};
  return out;
}

SlabCoefficients coefficients(std::vector<Material> layers, bool from_last, double cosine) {
  if (from_last) std::ranges::reverse(layers);
  std::vector<WallLayer> wall;
  for (const Material& layer : layers) wall.push_back({complex_permittivity(layer, hz), layer.thickness_m});
  return wall_coefficients(wall, cosine, test::wavelength_m);
}

// The plane x = 0 with its outer side at x > 0, or at x < 0 if `below`, and a path that it reflects at x > 0 or x < 0.
Complex reflected_te(const Material& material, bool below, double x) {
  test::World world(hz);
  const uint32_t plane = world.add_plane({1, 0, 0}, {0, 0, 0}, material);
  world.scene.surfaces[plane].outer_is_below = below;
  world.config.transmitters = {test::World::end({x, 0, 0})};
  world.config.receivers = {test::World::end({x, 8, 0})};
  world.add_reflections(0, 0, {plane});
  const Paths paths = world.paths();
  REQUIRE(paths.size() == 1);
  return paths.a[0][0] * (4 * std::numbers::pi * std::hypot(2 * x, 8.0) / test::wavelength_m);
}

}  // namespace

TEST_CASE("walls of layers: reflection is that of the side that a wave meets") {
  const double cosine = 0.6;  // 3 m from the plane, 8 m along it
  for (const Material& material : {clad(), insulated()})
    for (const bool below : {false, true})
      for (const double x : {3.0, -3.0}) {
        CAPTURE(below);
        CAPTURE(x);
        const bool from_last = (x > 0) == below;
        // The polarisation is along z, normal to the plane of incidence; vertical waves have it with both signs.
        const Complex met = coefficients(material.layers, from_last, cosine).reflection_te;
        const Complex other = coefficients(material.layers, !from_last, cosine).reflection_te;
        const Complex found = reflected_te(material, below, x);
        CHECK(std::abs(found - met) < 1e-12);
        CHECK(std::abs(found - other) > 0.02);
      }
}

TEST_CASE("walls of layers: transmission does not depend on the side, nor on the outer side") {
  std::vector<Complex> found;
  for (const bool below : {false, true})
    for (const double x : {3.0, -3.0}) {
      test::World world(hz);
      const uint32_t plane = world.add_plane({1, 0, 0}, {0, 0, 0}, insulated());
      world.scene.surfaces[plane].outer_is_below = below;
      world.config.transmitters = {test::World::end({x, 0, 0})};
      world.config.receivers = {test::World::end({-x, 0, 0})};
      world.config.trace.transmission = true;
      world.add_path(0, 0, {plane}, {transmission}, {{0, 0, 0}});
      found.push_back(world.paths().a.at(0)[0] * (4 * std::numbers::pi * 6 / test::wavelength_m));
    }
  CHECK(std::abs(found[0] - coefficients(insulated().layers, false, 1).transmission_te) < 1e-12);
  for (const Complex& other : found) CHECK(std::abs(other - found[0]) < 1e-14);
}

// The wave of an edge takes over at the place at which the reflection at the half plane ends. That holds only if the
// edge reflects as the side that the wave meets.
TEST_CASE("walls of layers: the field is continuous where the reflection at either side of a half plane ends") {
  for (const Material& material : {clad(), insulated()})
    for (const double x : {10.0, -10.0}) {
      CAPTURE(x);
      Complex total[2];
      for (const int lit : {0, 1}) {
        test::World world(hz);
        const uint32_t plane = world.add_plane({1, 0, 0}, {0, 0, 0}, material);
        world.scene.wedges = {{.start = {0, -50, 0},
                               .along = {0, 1, 0},
                               .length_m = 100,
                               .face = {0, 0, -1},
                               .normal = {1, 0, 0},
                               .exterior_rad = 2 * std::numbers::pi,
                               .surface = {plane, plane},
                               .plane = {plane, plane}}};
        const double z = 3 + (lit ? -1e-5 : 1e-5);
        world.config.trace.diffraction = true;
        world.config.transmitters = {test::World::end({x, 0, -3}, "isotropic", "H")};
        world.config.receivers = {test::World::end({x, 0, z}, "isotropic", "H")};
        world.add_path(0, 0, {0}, {diffraction}, {{0, 0, 0}});
        if (lit) world.add_path(0, 0, {plane}, {reflection}, {{0, 0, (z - 3) / 2}});
        const Paths paths = world.paths();
        REQUIRE(paths.size() == 1u + lit);
        for (size_t i = 0; i < paths.size(); ++i)
          total[lit] += paths.a[i][0] * std::polar(1.0, -2 * std::numbers::pi * hz * paths.delay_s[i]);
      }
      CHECK(std::abs(total[0]) > 1e-5);
      CHECK(std::abs(total[1] - total[0]) < 1e-3 * std::abs(total[0]));
    }
}

TEST_CASE("walls of layers: tiles scatter as much as the side reflects that they are on") {
  for (const double x : {3.0, -3.0}) {
    test::World world(hz);
    Material rough = insulated();
    rough.scattering = 0.5;
    world.add_plane({1, 0, 0}, {0, 0, 0}, rough);
    const MaterialTable table = make_material_table(world.scene, {}, {}, hz);
    const device::wt_material& record = table.materials[table.materials_of[0]];
    const device::wt_layers layers = device::wt_layers_of(table.materials.data(), record.layers, x < 0);
    const device::wt_double2 roots = device::wt_roots_of_reflection(&record, layers, 0.7, test::wavelength_m);
    const SlabCoefficients side = coefficients(rough.layers, x < 0, 0.7);
    CHECK(roots.x * roots.x == test::near(std::abs(side.reflection_te), 1e-12));
    CHECK(roots.y * roots.y == test::near(std::abs(side.reflection_tm), 1e-12));
  }
}

TEST_CASE("walls of layers: the table has them once, and a second wall for surfaces whose outer side is below") {
  test::World world(hz);
  for (const bool below : {false, true}) {
    const uint32_t plane = world.add_plane({1, 0, 0}, {0, 0, 0}, insulated());
    world.scene.surfaces[plane].material = 0;
    world.scene.surfaces[plane].outer_is_below = below;
  }
  world.add_plane({1, 0, 0}, {5, 0, 0}, test::concrete(0.2));
  world.scene.materials = {insulated(), test::concrete(0.2)};
  world.scene.surfaces[2].material = 1;
  const MaterialTable table = make_material_table(world.scene, {}, {}, hz);
  REQUIRE(table.materials.size() == 2 + 3 + 1);
  CHECK(table.materials_of == std::vector<uint32_t>{0, 5, 1});
  CHECK(table.materials[0].layers == (2u << WT_LAYER_SHIFT | 3u));
  CHECK(table.materials[5].layers == (2u << WT_LAYER_SHIFT | WT_LAYERS_REVERSED | 3u));
  CHECK(table.materials[1].layers == 0);
  CHECK(table.materials[3].permittivity[0] == 1.1);
}

TEST_CASE("walls of layers: bounds of reflectances hold on both sides at every angle") {
  test::World world(hz);
  world.add_plane({1, 0, 0}, {0, 0, 0}, insulated());
  const ReflectanceBounds bounds = make_reflectance_bounds(world.scene, {}, {}, std::vector<double>{hz});
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> cosines(0, 1);
  size_t broken = 0, loose = 0;
  std::array<double, WT_COSINES> most{};
  for (int i = 0; i < 100000; ++i) {
    const double cosine = cosines(engine);
    const auto k = static_cast<size_t>(cosine * WT_COSINES);
    for (const bool from_last : {false, true}) {
      const SlabCoefficients side = coefficients(insulated().layers, from_last, cosine);
      most[k] = std::max({most[k], std::norm(side.reflection_te), std::norm(side.reflection_tm)});
    }
    broken += most[k] > bounds.bounds[bounds.materials_of[0] * WT_COSINES + k];
  }
  for (size_t k = 0; k < WT_COSINES; ++k) loose += bounds.bounds[k] > std::min(1.0, 1.05 * most[k] + 1e-6);
  CHECK(broken == 0);
  CHECK(loose == 0);
}

TEST_CASE("walls of layers: one opaque layer makes them opaque, and ranges are those of the layers") {
  CHECK(is_opaque(clad(), hz));
  CHECK_FALSE(is_opaque(insulated(), hz));
  Material wall = insulated();
  wall.layers[1] = {"floorboard", 3.66, 0, 0.0044, 1.3515, 50, 100, 0.1};
  CHECK(range_problem({&wall, 1}, hz).find("the material \"floorboard\" is only known from 50 to 100 GHz") !=
        std::string::npos);
  CHECK(range_problem(std::vector<Material>{insulated(), clad()}, hz).empty());
  CHECK_THROWS_AS(is_opaque(wall, hz), ConfigError);
}
