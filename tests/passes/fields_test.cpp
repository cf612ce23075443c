// SPDX-License-Identifier: Apache-2.0
// fields: a handful of paths against Friis, Fresnel's coefficients and reciprocity, and to the last bit against the
// host's evaluation of the same functions; rows without a path, and paths the other way.
#include "passes/fields.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <complex>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "passes/field_columns.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

doctest::Approx within(double value, double relative) { return doctest::Approx(value).epsilon(relative).scale(0); }

// Fresnel's coefficients of the ground for a wave that meets it at this angle from its normal: TE, TM.
std::array<std::complex<double>, 2> fresnel(double cosine) {
  // ITU-R P.2040-3: the imaginary part is conductivity / (2 pi frequency epsilon_0), and decays with exp(j 2 pi f t).
  const double conductivity = 0.0462 * std::pow(frequency_hz / 1e9, 0.7822);
  const std::complex<double> e(5.24, -conductivity / (2 * std::numbers::pi * frequency_hz * 8.8541878128e-12));
  const std::complex<double> root = std::sqrt(e - (1 - cosine * cosine));
  return {(cosine - root) / (cosine + root), (e * cosine - root) / (e * cosine + root)};
}

// A place on the plane of the ground or of the wall where the way from a to b is mirrored.
glm::dvec3 mirror_point(uint32_t surface, const glm::dvec3& a, const glm::dvec3& b) {
  const int axis = surface == ground ? 2 : 1;
  const double plane = surface == ground ? 0 : 8, from = std::abs(a[axis] - plane), to = std::abs(b[axis] - plane);
  glm::dvec3 out = a + (b - a) * (from / (from + to));
  out[axis] = plane;
  return out;
}

// Wedges whose edges stand in the street: a half plane, walls that meet at right angles, and bends that are wider and
// narrower. Faces are the ground's, the wall's and the screen's materials.
void add_edges(Scene& scene) {
  for (const double exterior : {2.0, 1.5, 1.4, 1.7, 1.02}) {
    const double x = -10 + 5 * exterior;
    scene.wedges.push_back({.start = {x, 2, 0},
                            .along = {0, 0, 1},
                            .length_m = 9,
                            .face = {1, 0, 0},
                            .normal = {0, 1, 0},
                            .exterior_rad = exterior * std::numbers::pi,
                            .surface = {exterior > 1.6 ? ground : screen, exterior > 1.9 ? ground : conducting_wall},
                            .plane = {exterior > 1.6 ? ground : screen, exterior > 1.9 ? ground : conducting_wall}});
  }
}

// Random paths of all shapes with up to three interactions: mirrors, and one edge of the wedges from `first` on.
std::vector<PathRow> random_paths(const Scene& scene, uint32_t first, size_t count) {
  std::mt19937 engine(7);
  const auto random = [&] { return static_cast<uint32_t>(engine()); };
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(engine); };
  std::vector<PathRow> rows;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t before = random() % 3, after = random() % (3 - before), bends = random() % 4 > 0;
    const auto edge = static_cast<uint32_t>(first + random() % (scene.wedges.size() - first));
    const Wedge& wedge = scene.wedges[edge];
    const auto place = [&] {  // in the free space of the wedge, some of them nearly on a face
      const double angle = random() % 8 == 0 ? 1e-10 : uniform(0, std::min(wedge.exterior_rad, 0.9 * std::numbers::pi));
      const double away_m = random() % 16 == 0 ? 0.03 : uniform(0.5, 5);
      glm::dvec3 at = wedge.start + wedge.face * (away_m * std::cos(angle)) + wedge.normal * (away_m * std::sin(angle));
      at.z = uniform(0.5, 8);
      return at;
    };
    PathRow row{.from = place(), .to = place(), .steps = {}, .points = {}};
    const glm::dvec3 at = wedge.start + wedge.along * uniform(1, 8);
    if (bends && random() % 8 == 0) row.to = at + (at - row.from);             // on the boundary of the shadow
    if (!bends && random() % 8 == 0) row.to = row.from + glm::dvec3{0, 0, 2};  // the ground is met at its normal
    const auto mirrors = [&](uint32_t number, const glm::dvec3& a, const glm::dvec3& b) {
      glm::dvec3 from = a;
      for (uint32_t k = 0; k < number; ++k) {
        const uint32_t surface = random() % 3 == 0 ? conducting_wall : ground;
        row.steps.push_back(WT_STEP_REFLECTION | surface);
        row.points.push_back(mirror_point(surface, from, b));
        from = row.points.back();
        if (random() % 2 == 0) from.x += 0.5;  // the next leg has a length
      }
    };
    mirrors(before, row.from, bends ? at : row.to);
    if (bends) {
      row.steps.push_back(WT_STEP_DIFFRACTION | edge);
      row.points.push_back(at);
      mirrors(after, at, row.to);
    }
    rows.push_back(row);
  }
  return rows;
}

// The bits of all coefficients, so that zeros have their signs.
std::vector<uint64_t> coefficient_bits(const Paths& paths) {
  std::vector<uint64_t> out;
  for (const auto& matrix : paths.a)
    for (const std::complex<double>& a : matrix)
      out.insert(out.end(), {std::bit_cast<uint64_t>(a.real()), std::bit_cast<uint64_t>(a.imag())});
  return out;
}

}  // namespace

TEST_CASE("fields: many paths of all shapes, which CPUs compute eight at once, have the host's bits") {
  for (const std::string antenna : {"isotropic", "dipole"}) {
    CAPTURE(antenna);
    FieldWorld world({}, antenna);
    const auto first = static_cast<uint32_t>(world.scene.wedges.size());
    add_edges(world.scene);
    const std::vector<PathRow> rows = random_paths(world.scene, first, as_many(700, 100));
    const Scene scene = world.scene;
    world = FieldWorld(rows, antenna);
    world.scene = scene;
    world.config.trace.transmission = false;
    const Paths found = in_order(world), expected = on_host(world);
    REQUIRE(found.size() == rows.size());
    CHECK(same_columns(found, expected));
    CHECK(coefficient_bits(found) == coefficient_bits(expected));
    CHECK(std::ranges::count(found.depth, 3) > found.size() / 10);
  }
}

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
        std::vector<uint32_t>{ground, conducting_wall, ground, conducting_wall, screen, 2, corner_wedge});
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
