// SPDX-License-Identifier: Apache-2.0
// fields: a handful of paths against Friis, Fresnel's coefficients and reciprocity, and to the last bit against the
// host's evaluation of the same functions; rows without a path, and paths the other way.
#include "passes/fields.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <limits>
#include <numbers>

#include "passes/field_world.hpp"
#include "passes/wedges.hpp"
#include "radio/fields.hpp"
#include "wavetracer/device/path_rows.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t no_path = WT_NO_ROW;

bool same_columns(const Paths& a, const Paths& b) {
  return a.frame == b.frame && a.tx == b.tx && a.rx == b.rx && a.depth == b.depth && a.delay_s == b.delay_s &&
         a.gain_db == b.gain_db && a.a == b.a && a.aod_theta_rad == b.aod_theta_rad && a.aod_phi_rad == b.aod_phi_rad &&
         a.aoa_theta_rad == b.aoa_theta_rad && a.aoa_phi_rad == b.aoa_phi_rad && a.doppler_hz == b.doppler_hz &&
         a.quarters == b.quarters && a.vertex_offset == b.vertex_offset && a.vertex_position_m == b.vertex_position_m &&
         a.vertex_interaction == b.vertex_interaction && a.vertex_surface == b.vertex_surface &&
         a.vertex_instance == b.vertex_instance;
}

// Computes every third of these paths once more: those have their columns, in their order.
void check_chosen(Fields& fields, const FieldInputs& inputs, const WorldState& state, const Paths& paths) {
  std::vector<uint32_t> chosen;
  for (uint32_t row = 0; row < paths.size(); row += 3) chosen.push_back(row);
  const RowChoice choice = fields.choose(inputs.rows, chosen);
  REQUIRE(choice.count == chosen.size());
  fields.again(inputs, choice);
  fields.begin_read_carrier({choice.count, 0});
  context().finish();
  const CarrierFields again = fields.carrier({choice.count, 0});
  REQUIRE(again.a.size() == chosen.size());
  for (size_t i = 0; i < chosen.size(); ++i) {
    CHECK(again.a[i] == paths.a[chosen[i]]);
    CHECK(again.gain_db[i] == paths.gain_db[chosen[i]]);
  }
  fields(inputs, state, {static_cast<uint32_t>(paths.size()), static_cast<uint32_t>(paths.vertex_position_m.size())});
}

// Computes rows at their places on the device. numbers: twice the number of a path, plus one for its way back, or
// no_path. receiver_of, transmitter_of: ends in one place.
Paths fields_of(const FieldWorld& world, const std::vector<uint32_t>& numbers, const std::vector<uint32_t>& receiver_of,
                const std::vector<uint32_t>& transmitter_of) {
  const auto places = static_cast<uint32_t>(numbers.size());
  RowList list;
  list.places = places;
  std::vector<double> delays(places, 0);
  std::vector<uint32_t> before(2 * places + 1);  // sums of ones, then of depths
  RowCounts count;
  for (uint32_t place = 0; place < places; ++place) {
    before[place] = count.rows;
    if (numbers[place] == no_path) continue;
    delays[place] = world.length_m(numbers[place] / 2) / light_m_s;
    ++count.rows;
  }
  for (uint32_t place = 0; place < places; ++place) {
    before[places + place] = count.rows + count.vertices;
    if (numbers[place] != no_path) count.vertices += static_cast<uint32_t>(world.rows[numbers[place] / 2].steps.size());
  }
  list.rows = context().buffer(numbers, "rows");
  list.counts = context().buffer(before, "rows before");
  list.delays = context().buffer(delays, "delays");
  list.quarters = context().buffer(std::vector<uint8_t>(places, WT_ALL_QUARTERS), "quarters");

  const DeviceScene scene = make_device_scene(context(), world.scene, false, 200);
  const Wedges wedges(context(), world.scene, {}, {}, true);
  const Distinct distinct(context(), receiver_of, transmitter_of);
  const RadioEnds ends = make_radio_ends(context(), world.state.transmitters, world.state.receivers, {});
  const SolvedList visible = upload_rows(world.rows, most_steps);
  const FieldTables tables = make_field_tables(world.scene, world.config);
  CHECK(tables.corners);
  const FieldInputs inputs{scene, &wedges.list().wedges, nullptr, ends, visible, nullptr, distinct, list};
  const auto computed = [&](bool apart) {
    Fields fields(context(), tables, 1, world.scene.origin_m, apart);
    fields(inputs, world.state, count);
    return fields;
  };
  Fields together = computed(false);
  together.begin_read(5, count);
  together.size_room();
  context().finish();
  const Paths all_together = together.columns(count);
  Fields fields = computed(true);
  fields.begin_read(5, {count.rows / 2, count.vertices / 2});  // the rest is read once their number is known
  fields.size_room();
  context().finish();
  Paths paths = fields.columns(count);
  CHECK(same_columns(paths, all_together));
  check_chosen(fields, inputs, world.state, paths);
  for (const uint32_t expected : {count.rows, count.rows + count.rows / 8}) {  // in parts, if there are many
    fields.begin_read(5, {expected, count.vertices + 7});
    fields.size_room();
    fields.fill_arriving(count);
    context().finish();
    Paths again = fields.columns(count);
    CHECK(same_columns(again, paths));
    fields.give_room(std::move(again));
  }
  return paths;
}

Paths in_order(const FieldWorld& world) {
  std::vector<uint32_t> numbers;
  for (uint32_t i = 0; i < world.rows.size(); ++i) numbers.push_back(2 * i);
  const std::vector<uint32_t> alone(numbers.size(), WT_NONE);
  return fields_of(world, numbers, alone, alone);
}

// The same rows by the host's evaluation of the same functions.
Paths on_host(const FieldWorld& world) {
  PathGeometry geometry;
  for (uint32_t i = 0; i < world.rows.size(); ++i) {
    const PathRow& row = world.rows[i];
    geometry.tx.push_back(i);
    geometry.rx.push_back(i);
    geometry.quarters.push_back(WT_ALL_QUARTERS);
    for (size_t k = 0; k < row.steps.size(); ++k) {
      geometry.surface.push_back(row.steps[k] & ~WT_STEP_KIND);
      geometry.interaction.push_back(static_cast<uint8_t>(WT_STEP_CODES >> 8 * (row.steps[k] >> WT_STEP_SHIFT)));
      geometry.vertex.push_back(row.points[k]);
    }
    geometry.first.push_back(geometry.surface.size());
  }
  return FieldModel(world.scene, world.config).compute(5, geometry, world.state);
}

doctest::Approx within(double value, double relative) { return doctest::Approx(value).epsilon(relative).scale(0); }

// Fresnel's coefficients of the ground for a wave that meets it at this angle from its normal: TE, TM.
std::array<std::complex<double>, 2> fresnel(double cosine) {
  // ITU-R P.2040-3: the imaginary part is conductivity / (2 pi frequency epsilon_0), and decays with exp(j 2 pi f t).
  const double conductivity = 0.0462 * std::pow(frequency_hz / 1e9, 0.7822);
  const std::complex<double> e(5.24, -conductivity / (2 * std::numbers::pi * frequency_hz * 8.8541878128e-12));
  const std::complex<double> root = std::sqrt(e - (1 - cosine * cosine));
  return {(cosine - root) / (cosine + root), (e * cosine - root) / (e * cosine + root)};
}

}  // namespace

TEST_CASE("fields: a path in sight has Friis' gain, its delay, its angles and the Doppler shift of its ends") {
  const FieldWorld world({field_row({-30, 1, 2}, {6, 0, 5}, {}, {}), field_row({3, -4, 1}, {3, 2, 9}, {}, {})},
                         "isotropic");
  const Paths paths = in_order(world);
  REQUIRE(paths.size() == 2);
  CHECK(paths.frame == std::vector<uint32_t>{5, 5});
  CHECK(paths.rx_ports == 2);
  for (size_t i = 0; i < 2; ++i) {
    const glm::dvec3 way = world.rows[i].to - world.rows[i].from;
    const double length = glm::length(way), friis = carrier_wave_m / (4 * std::numbers::pi * length);
    CHECK(paths.tx[i] == i);
    CHECK(paths.rx[i] == i);
    CHECK(paths.depth[i] == 0);
    CHECK(paths.delay_s[i] == within(length / light_m_s, 1e-15));
    CHECK(std::norm(paths.a[i][0]) + std::norm(paths.a[i][2]) == within(friis * friis, 1e-12));
    CHECK(std::norm(paths.a[i][1]) + std::norm(paths.a[i][3]) == within(friis * friis, 1e-12));
    CHECK(paths.gain_db[i] == within(20 * std::log10(friis) + 10 * std::log10(2.0), 1e-12));
    CHECK(paths.aod_theta_rad[i] == within(std::acos(way.z / length), 1e-12));
    CHECK(paths.aod_phi_rad[i] == within(std::atan2(way.y, way.x), 1e-12));
    CHECK(paths.aoa_theta_rad[i] == within(std::acos(-way.z / length), 1e-12));
    const glm::dvec3 apart = world.state.receivers[i].velocity_m_s - world.state.transmitters[i].velocity_m_s;
    CHECK(paths.doppler_hz[i] == within(-glm::dot(apart, way) / length / carrier_wave_m, 1e-12));
  }
}

TEST_CASE("fields: the ground reflects by Fresnel's coefficients, and a conductor everything") {
  const FieldWorld world(path_of_each_kind(), "isotropic");
  const Paths paths = in_order(world);
  REQUIRE(paths.size() == world.rows.size());
  const double length = world.length_m(1), friis = carrier_wave_m / (4 * std::numbers::pi * length);
  const auto [te, tm] = fresnel(6 / length);  // 2 m and 4 m above the ground
  CHECK(std::abs(paths.a[1][0]) == within(friis * std::abs(tm), 1e-9));
  CHECK(std::abs(paths.a[1][3]) == within(friis * std::abs(te), 1e-9));
  CHECK(std::abs(paths.a[1][1]) + std::abs(paths.a[1][2]) < 1e-15);
  const double off_wall = carrier_wave_m / (4 * std::numbers::pi * world.length_m(2));
  CHECK(paths.gain_db[2] == within(20 * std::log10(off_wall) + 10 * std::log10(2.0), 1e-12));
  CHECK(paths.vertex_offset == std::vector<uint64_t>{0, 0, 1, 2, 4, 5, 6, 7});
  CHECK(paths.vertex_surface ==
        std::vector<uint32_t>{ground, conducting_wall, ground, conducting_wall, screen, 2, corner});
  CHECK(paths.vertex_position_m[0] == world.rows[1].points[0] + world.scene.origin_m);
  CHECK(paths.vertex_interaction ==
        std::vector<uint8_t>{reflection, reflection, reflection, reflection, transmission, diffraction, diffraction});
}

TEST_CASE("fields: every column is the host's to the last bit, for each kind of interaction and antenna") {
  for (const std::string antenna : {"isotropic", "dipole", "tr38901"}) {
    CAPTURE(antenna);
    const FieldWorld world(path_of_each_kind(), antenna);
    CHECK(same_columns(in_order(world), on_host(world)));
  }
}

TEST_CASE("fields: walls of layers have the host's bits, and reflect by the side that a wave meets") {
  const Material metal{.name = "metal", .a = 1, .c = 1e7, .thickness_m = 0.001},
      wood{.name = "wood", .a = 1.99, .c = 0.03, .thickness_m = 0.03},
      brick{.name = "brick", .a = 3.91, .c = 0.03, .thickness_m = 0.12};
  std::vector<PathRow> rows = path_of_each_kind();
  for (const double x : {-30.0, 50.0})  // off the screen, from both sides, and through it the other way
    rows.push_back(field_row({x, -4, 1}, {x, 4, 2}, {WT_STEP_REFLECTION | screen}, {{10, 0, 1.5}}));
  rows.push_back(field_row({20, 0, 2}, {0, 0, 2}, {WT_STEP_TRANSMISSION | screen}, {{10, 0, 2}}));
  rows.push_back(field_row({0, 0, 1}, {20, 0, 2}, {WT_STEP_DIFFRACTION | 2}, {{10, 0, 3}}));
  FieldWorld world(rows, "isotropic");
  const auto layer = [&](uint32_t surface, std::vector<Material> layers) {
    world.scene.materials[surface].layers = std::move(layers);
  };
  layer(screen, {wood, brick, wood, metal});
  const Paths opaque = in_order(world);
  CHECK(same_columns(opaque, on_host(world)));
  CHECK(std::abs(opaque.gain_db[7] - opaque.gain_db[8]) > 0.5);  // wood, or bare metal
  layer(screen, {brick, wood});
  layer(ground, {wood, brick, metal});
  layer(conducting_wall, {wood, metal});
  world.scene.surfaces[screen].outer_is_below = true;
  const Paths paths = in_order(world);
  CHECK(same_columns(paths, on_host(world)));
  CHECK(std::abs(paths.gain_db[7] - paths.gain_db[8]) > 0.5);
  CHECK(paths.gain_db[4] == within(paths.gain_db[9], 1e-13));
  world.scene.surfaces[screen].outer_is_below = false;
  const Paths turned = in_order(world);
  CHECK(turned.gain_db[7] == within(paths.gain_db[8], 1e-13));
  CHECK(turned.gain_db[8] == within(paths.gain_db[7], 1e-13));
  CHECK(std::abs(turned.gain_db[10] - paths.gain_db[10]) > 1e-4);  // over the edge of the screen
}

TEST_CASE("fields: many rows are read in parts, and each has the columns of its path") {
  const FieldWorld world(path_of_each_kind(), "isotropic");
  const Paths kinds = in_order(world);
  const auto count = static_cast<uint32_t>(kinds.size());
  std::vector<uint32_t> numbers;
  for (uint32_t i = 0; i < as_many(3, 1) * Fields::rows_of_part; ++i) numbers.push_back(2 * (i * i % count));
  const std::vector<uint32_t> alone(count, WT_NONE);
  const Paths paths = fields_of(world, numbers, alone, alone);
  REQUIRE(paths.size() == numbers.size());
  bool same = true;
  for (size_t i = 0; i < paths.size(); ++i) {
    const size_t kind = numbers[i] / 2;
    same = same && paths.tx[i] == kind && paths.depth[i] == kinds.depth[kind] &&
           paths.delay_s[i] == kinds.delay_s[kind] && paths.a[i] == kinds.a[kind] &&
           paths.vertex_offset[i + 1] - paths.vertex_offset[i] == kinds.depth[kind];
    for (uint32_t k = 0; same && k < kinds.depth[kind]; ++k)
      same =
          paths.vertex_position_m[paths.vertex_offset[i] + k] == kinds.vertex_position_m[kinds.vertex_offset[kind] + k];
  }
  CHECK(same);
}

TEST_CASE("fields: the way back of a path has its coefficients, transposed, and places without a path are left out") {
  // Transmitter i + 3 is where receiver i is, and receiver i + 3 where transmitter i is. Nothing moves.
  const std::vector<PathRow> kinds = path_of_each_kind();
  std::vector<PathRow> rows;
  for (const size_t i : {1, 3, 5}) rows.push_back(kinds[i]);
  FieldWorld world(rows, "dipole");
  std::vector<uint32_t> twin(6);
  for (uint32_t i = 0; i < 6; ++i) twin[i] = (i + 3) % 6;
  for (uint32_t i = 0; i < 3; ++i) {
    for (auto* ends : {&world.config.transmitters, &world.config.receivers}) ends->push_back(ends->front());
    world.state.transmitters[i].velocity_m_s = world.state.receivers[i].velocity_m_s = {0, 0, 0};
  }
  for (uint32_t i = 0; i < 3; ++i) {
    world.state.transmitters.push_back(world.state.receivers[i]);
    world.state.receivers.push_back(world.state.transmitters[i]);
  }
  const Paths paths = fields_of(world, {0, no_path, 2, 4, no_path, 1, 3, no_path, 5, no_path}, twin, twin);
  REQUIRE(paths.size() == 6);
  CHECK(paths.tx == std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
  CHECK(paths.rx == std::vector<uint32_t>{0, 1, 2, 3, 4, 5});
  for (size_t there = 0; there < 3; ++there) {
    CAPTURE(there);
    const size_t back = there + 3;
    CHECK(paths.depth[there] == rows[there].steps.size());
    CHECK(paths.delay_s[back] == paths.delay_s[there]);
    CHECK(paths.aod_theta_rad[back] == within(paths.aoa_theta_rad[there], 1e-12));
    const double size = std::pow(10, paths.gain_db[there] / 20);
    CHECK(size > 0);
    for (const auto& [port, transposed] : {std::pair{0, 0}, {1, 2}, {2, 1}, {3, 3}})
      CHECK(std::abs(paths.a[back][transposed] - paths.a[there][port]) < 1e-12 * size);
    for (size_t k = 0; k < rows[there].steps.size(); ++k)
      CHECK(paths.vertex_position_m[paths.vertex_offset[back] + k] ==
            paths.vertex_position_m[paths.vertex_offset[there + 1] - 1 - k]);
  }
}
