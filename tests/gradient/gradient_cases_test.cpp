// SPDX-License-Identifier: Apache-2.0
// Derivatives where a closed form is known, in air and leaves, off vehicles, beside boundaries, and where there are
// none.
#include <doctest/doctest.h>

#include <cstring>

#include "gradient/gradient_differences.hpp"
#include "gradient/path_tables.hpp"
#include "radio/field_frame.hpp"

using namespace wavetracer;
using test::D;
using test::dvec3;
using test::GradientWorld;
using test::R;
using test::S;
using test::T;

namespace {

GradientWorld mixed_world(uint64_t seed) {
  GradientWorld world(seed);
  std::mt19937_64 random(seed);
  for (const auto& kinds :
       std::vector<std::vector<uint8_t>>{{}, {R}, {R, T, R}, {S}, {R, S}, {D}, {R, D, R}, {D, D}, {R, D, D}, {D, D, D}})
    test::add_random(world, kinds, 3, random);
  return world;
}

dvec3 direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// The entry of a parameter of row 0.
size_t entry_of(const ModelGradients& of, PathParameter parameter) {
  for (uint64_t entry = of.first[0]; entry < of.first[1]; ++entry)
    if (of.parameter[entry] == parameter) return entry;
  FAIL("the path has no such parameter");
  return 0;
}

ModelGradients gradients_of(const GradientWorld& world) {
  return GradientModel(world.scene, world.config)
      .compute(0, world.geometry(world.state), world.state, {.orientations = true});
}

// A plane of concrete below two ends.
GradientWorld over_ground(const dvec3& tx, const dvec3& rx, double scatters) {
  GradientWorld world(1);
  world.scene.materials[3].scattering = scatters;
  std::mt19937_64 random(1);
  uint32_t ground = 0;
  while (world.scene.materials[world.scene.surfaces[ground].material].thickness_m != test::infinity) ++ground;
  world.add({{R, ground}}, tx, rx, random);
  return world;
}

}  // namespace

TEST_CASE("values of derivatives are those of FieldModel to the last bit, with all their rows") {
  for (const uint64_t seed : {21, 22}) {
    const GradientWorld world = mixed_world(seed);
    const PathGeometry geometry = world.geometry(world.state);
    const Paths paths = FieldModel(world.scene, world.config).compute(3, geometry, world.state);
    const FieldTables tables = make_field_tables(world.scene, world.config);
    const FieldFrame frame = make_field_frame(tables, world.scene, {}, {}, geometry, world.state);
    const device::wt_field_world plain = frame.world(tables);
    const ConstantTables constants = constant_tables(tables);
    REQUIRE(paths.size() == frame.rows.size());
    PathTables path(tables, constants, frame, plain);
    for (uint32_t row = 0; row < paths.size(); ++row) {
      path.set_row(row);
      tangent::Tangent delay;
      const std::span<const PathDirection> directions = path.material_directions();
      const auto field = path.fields(directions.first(std::min<size_t>(directions.size(), 1)), 5.9e9, delay);
      CHECK(same_bits(delay.value, paths.delay_s[row]));
      CHECK(same_bits(field.gain_db.value, paths.gain_db[row]));
      CHECK(same_bits(field.departure.phi.value, paths.aod_phi_rad[row]));
      CHECK(same_bits(field.arrival.theta.value, paths.aoa_theta_rad[row]));
      for (size_t port = 0; port < 4; ++port) {
        CHECK(same_bits(field.a[port].x.value, paths.a[row][port].real()));
        CHECK(same_bits(field.a[port].y.value, paths.a[row][port].imag()));
      }
    }
    CHECK(gradients_of(world).paths.a == paths.a);
  }
}

TEST_CASE("the delay changes by the component along the first and the last leg, for every kind of path") {
  for (const uint64_t seed : {23, 24, 25}) {
    const GradientWorld world = mixed_world(seed);
    const ModelGradients of = gradients_of(world);
    const Paths& paths = of.paths;
    for (size_t row = 0; row < paths.size(); ++row) {
      const dvec3 out = direction(paths.aod_theta_rad[row], paths.aod_phi_rad[row]);
      const dvec3 back = direction(paths.aoa_theta_rad[row], paths.aoa_phi_rad[row]);
      int found = 0;
      for (uint64_t entry = of.first[row]; entry < of.first[row + 1]; ++entry) {
        const int axis = static_cast<int>(of.parameter[entry]) - static_cast<int>(PathParameter::tx_x);
        double expected = 0;  // materials and turns move nothing
        if (axis >= 0 && axis < 6) expected = -(axis < 3 ? out : back)[axis % 3] / speed_of_light_m_s;
        found += axis >= 0 && axis < 6;
        CHECK(std::abs(of.delay_s[entry] - expected) < 1e-12 / speed_of_light_m_s);
      }
      CHECK(found == 6);
    }
  }
}

TEST_CASE("a path that misses a material has no entry for it, and one by itself has those of its ends alone") {
  const GradientWorld world = over_ground({0, 0, 5}, {20, 3, 7}, 0.5);
  const ModelGradients of = gradients_of(world);
  CHECK(of.size() == 4 + 6 + 6);
  for (size_t entry = 0; entry < of.size(); ++entry)
    CHECK(of.material[entry] == (of.parameter[entry] < PathParameter::tx_x ? 3 : no_material_number));
  const GradientModel model(world.scene, world.config);
  const PathGeometry geometry = world.geometry(world.state);
  CHECK(model.compute(0, geometry, world.state, {true, false, false}).size() == 4);
  CHECK(model.compute(0, geometry, world.state, {false, true, false}).size() == 6);
  CHECK(model.compute(0, geometry, world.state, {false, false, true}).size() == 6);
  CHECK(model.compute(0, geometry, world.state, {false, false, false}).size() == 0);
}

TEST_CASE("derivatives in rain, gases and leaves, and of waves that leaves scatter, are those of differences") {
  for (const bool scatters : {false, true}) {
    GradientWorld world(26);
    world.config.air = {.rain_mm_h = 40, .gases = true};
    Material leaves{.name = "leaves", .scattering = scatters ? 0.3 : 0, .scattering_cross_polar = 0.1};
    leaves.vegetation = VegetationLaw{.attenuation_db_m = 0.4, .max_attenuation_db = 20};
    world.scene.materials.push_back(leaves);
    const auto material = static_cast<uint32_t>(world.scene.materials.size() - 1);
    using enum VolumeShape;
    for (const auto& [shape, x] :
         std::vector<std::pair<VolumeShape, double>>{{box, -15}, {cylinder, 0}, {spheroid, 12}})
      world.scene.volumes.push_back({shape, {x, 2, 9}, {9, 20, 8}, 0.3, {}, material});
    world.cells = make_cells(world.scene, world.config.trace.tile_m, 1 << 20);
    std::mt19937_64 random(26);
    for (const auto& kinds : std::vector<std::vector<uint8_t>>{{}, {R}, {T, R}, {D}, {R, S}})
      test::add_random(world, kinds, 4, random);
    if (scatters) {
      REQUIRE(world.cells.size() > 5);
      for (int i = 0; i < 5; ++i)
        world.add({{S, static_cast<uint32_t>(world.tiles.size() + random() % world.cells.size())}},
                  {-35, 3.0 * i - 5, 4.0 + i}, {33, 7 - 2.0 * i, 12.0 + i}, random);
    }
    test::check_worst(world, 18);
  }
}

TEST_CASE("a vehicle's surface has the derivatives of the same surface of the scene, and its material its number") {
  GradientWorld still = over_ground({0, 0, 5}, {20, 3, 7}, 0.5);
  const uint32_t ground = still.sequences[0][0].number;
  GradientWorld moving = still;
  Scene model;
  model.materials = {test::concrete(0.1), still.scene.materials[3]};
  model.surfaces = {still.scene.surfaces[ground]};
  model.surfaces[0].material = 1;
  model.surfaces[0].first_triangle = model.surfaces[0].triangle_count = 0;
  model.surfaces[0].offset_m = -2;
  const std::vector<Scene> models{model};
  const std::vector<Instance> instances{{"first", "car", 0, static_cast<uint32_t>(still.scene.surfaces.size()),
                                         static_cast<uint32_t>(still.scene.wedges.size())}};
  moving.state.instances = {{.position_m = {3, 4, still.scene.surfaces[ground].offset_m + 2}}};
  PathGeometry geometry = still.geometry(still.state);
  const ModelGradients expected = gradients_of(still);
  geometry.surface[0] = instances[0].first_surface;
  const ModelGradients of = GradientModel(moving.scene, moving.config, models, instances)
                                .compute(0, geometry, moving.state, {.orientations = true});
  REQUIRE(of.size() == expected.size());
  for (size_t entry = 0; entry < of.size(); ++entry) {
    for (size_t port = 0; port < 4; ++port)
      CHECK(std::abs(of.a[entry][port] - expected.a[entry][port]) <= 1e-12 * std::abs(expected.a[entry][port]) + 1e-20);
    if (of.parameter[entry] < PathParameter::tx_x) CHECK(of.material[entry] == still.scene.materials.size() + 1);
  }
}

// The straight path passes the edge by some micrometres, so its neighbour decides on which side of the boundary the
// diffracted path is. The field of the latter jumps there.
TEST_CASE("beside a shadow boundary the neighbouring path decides, for derivatives as for fields") {
  GradientWorld world(27);
  const uint32_t edge = test::edges_where(world, [](const Wedge& w) { return w.exterior_rad > 1.9 * test::pi; })[0];
  const Wedge& wedge = world.scene.wedges[edge];
  const dvec3 middle = wedge.start + 0.5 * wedge.length_m * wedge.along + 1e-6 * wedge.face;
  const dvec3 way = glm::normalize(wedge.normal + 0.3 * wedge.face + 0.2 * wedge.along);
  std::mt19937_64 random(27);
  world.add({{D, edge}}, middle - 10.0 * way, middle + 15.0 * way, random);
  world.one_link = true;
  const Paths alone = FieldModel(world.scene, world.config).compute(0, world.geometry(world.state), world.state);
  world.sequences.push_back({});
  const ModelGradients of = gradients_of(world);
  REQUIRE(of.paths.size() == 2);
  const size_t bent = of.paths.depth[0] == 1 ? 0 : 1;
  CHECK(std::abs(of.paths.a[bent][0] + alone.a[0][0]) < 0.1 * std::abs(alone.a[0][0]));  // the other side
  const auto steps =
      test::all_differences(world, PathParameter::permittivity, world.scene.surfaces[wedge.surface[0]].material);
  const size_t first = of.first[bent];
  REQUIRE(of.parameter[first] == PathParameter::permittivity);
  CHECK(test::error_of(test::slopes_of(of, first), steps[1][bent], test::columns_of(of.paths, bent)) < 1e-6);
}

TEST_CASE("where no derivative exists, or none is known, there is a gap and no number") {
  const auto check_gap = [](const ModelGradients& of, PathParameter parameter, GradientGap gap) {
    const size_t entry = entry_of(of, parameter);
    CHECK(of.gap[entry] == gap);
    for (const auto& a : of.a[entry]) CHECK(std::isnan(a.real()) == (gap != GradientGap::none));
    CHECK(std::isnan(of.delay_s[entry]) == (gap != GradientGap::none));
  };
  // sqrt(1 - S^2) has no slope at S = 1.
  const ModelGradients rough = gradients_of(over_ground({0, 0, 5}, {20, 3, 7}, 1));
  check_gap(rough, PathParameter::scattering, GradientGap::singular);
  check_gap(rough, PathParameter::permittivity, GradientGap::none);
  // Straight down, angles are those of a pole.
  GradientWorld vertical = over_ground({4, 5, 5}, {4, 5, 9}, 0.5);
  const ModelGradients down = gradients_of(vertical);
  check_gap(down, PathParameter::tx_y, GradientGap::pole);
  check_gap(down, PathParameter::conductivity, GradientGap::none);
  // Points that nobody solved do not move as reflections do.
  const GradientWorld world = over_ground({0, 0, 5}, {20, 3, 7}, 0.5);
  PathGeometry geometry = world.geometry(world.state);
  geometry.vertex[0].x += 1e-3;
  const ModelGradients moved = GradientModel(world.scene, world.config).compute(0, geometry, world.state);
  check_gap(moved, PathParameter::rx_z, GradientGap::not_solved);
  check_gap(moved, PathParameter::permittivity, GradientGap::none);
  // It is not known on which side of a face an end in its plane will be.
  GradientWorld roof(27);
  const uint32_t edge = test::edges_where(roof, [](const Wedge& w) { return w.exterior_rad > 1.9 * test::pi; })[0];
  const Wedge& wedge = roof.scene.wedges[edge];
  const dvec3 middle = wedge.start + 0.5 * wedge.length_m * wedge.along;
  std::mt19937_64 random(27);
  roof.add({{D, edge}}, middle + 7.0 * wedge.face + 1.0 * wedge.along, middle + 5.0 * wedge.normal, random);
  const ModelGradients along = gradients_of(roof);
  check_gap(along, PathParameter::tx_z, GradientGap::singular);
  check_gap(along, PathParameter::tx_turn_z, GradientGap::none);
  check_gap(along, PathParameter::permittivity, GradientGap::none);
  // Below its limit of 0 dB, vegetation takes nothing.
  GradientWorld leaves = over_ground({0, 0, 5}, {20, 3, 7}, 0.5);
  leaves.scene.materials.push_back({.name = "leaves"});
  leaves.scene.materials.back().vegetation = VegetationLaw{.attenuation_db_m = 0.4, .max_attenuation_db = 0};
  leaves.scene.volumes.push_back({VolumeShape::box, {10, 0, 3}, {5, 9, 5}, 0, {}, 4});
  check_gap(gradients_of(leaves), PathParameter::most_attenuation, GradientGap::singular);
  check_gap(gradients_of(leaves), PathParameter::attenuation, GradientGap::none);
}
