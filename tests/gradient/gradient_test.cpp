// SPDX-License-Identifier: Apache-2.0
// Derivatives of random paths against differences of the fields of FieldModel.
#include <doctest/doctest.h>

#include "gradient/gradient_differences.hpp"
#include "scene/free_ends.hpp"
#include "temporary_folder.hpp"

using namespace wavetracer;
using test::D;
using test::GradientWorld;
using test::R;
using test::S;
using test::T;

namespace {

constexpr size_t all_parameters = 16;  // four of materials, and those of the ends

void check_world(uint64_t seed, const std::vector<std::vector<uint8_t>>& kinds, int count, size_t most_jumps = 0) {
  CAPTURE(seed);
  GradientWorld world(seed);
  std::mt19937_64 random(seed);
  for (const auto& of_path : kinds) test::add_random(world, of_path, count, random);
  test::check_worst(world, all_parameters, most_jumps);
}

// A grid of 10 degrees with random samples.
std::string pattern_text() {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> sample(-1, 1);
  std::string text = "theta_deg,phi_deg,v_re,v_im,h_re,h_im\n";
  for (int theta = 0; theta <= 180; theta += 10)
    for (int phi = 0; phi < 360; phi += 10) {
      text += std::to_string(theta) + "," + std::to_string(phi);
      for (int i = 0; i < 4; ++i) text += "," + std::to_string(sample(random));
      text += "\n";
    }
  return text;
}

}  // namespace

TEST_CASE("derivatives of paths without edges are those of differences") {
  for (const uint64_t seed : {1, 2, 3})
    check_world(seed, {{}, {R}, {T}, {R, R}, {R, T}, {T, R, R}, {S}, {R, S}, {S, T}, {R, S, R}}, 4);
}

TEST_CASE("derivatives of paths over one edge are those of differences") {
  for (const uint64_t seed : {4, 5, 6}) check_world(seed, {{D}, {R, D}, {D, R}, {R, D, T}}, 8);
}

TEST_CASE("derivatives at corners, slight bends and half planes are those of differences") {
  GradientWorld world(10);
  std::mt19937_64 random(10);
  const auto add = [&](double from, double to) {
    const auto wedges = test::edges_where(
        world, [&](const Wedge& w) { return w.exterior_rad > from * test::pi && w.exterior_rad < to * test::pi; });
    test::add_random(world, {D}, 8, random, wedges);
    test::add_random(world, {R, D}, 4, random, wedges);
  };
  add(0.3, 0.9);
  add(0.91, 1.4);
  add(1.9, 2.1);
  test::check_worst(world, all_parameters);
}

TEST_CASE("derivatives by the layers of walls are those of differences") {
  GradientWorld world(12);
  for (const size_t wall : {0, 2})
    world.scene.materials[wall].layers = {test::plain_material(5.24, 0.12, 0.04, 0),
                                          test::plain_material(1.5, 0.01, 0.06, 0),
                                          test::plain_material(2.9, 0.03, 0.013, 0)};
  std::mt19937_64 random(12);
  for (const std::vector<uint8_t>& kinds : {std::vector<uint8_t>{R}, {T}, {R, T}, {D}, {S}})
    test::add_random(world, kinds, 4, random);
  test::check_worst(world, all_parameters);
  const ModelGradients found = GradientModel(world.scene, world.config)
                                   .compute(0, world.geometry(world.state), world.state, {.positions = false});
  const auto by_layers = std::ranges::count_if(found.material, [](uint32_t record) { return record > 3; });
  CHECK(by_layers >= 3 * 3 * 4);  // three properties of three layers for every path that meets such a wall
}

// The field of three edges and more may jump by rounding where two terms of an edge are equally near to their
// boundaries.
TEST_CASE("derivatives of paths over two edges and more are those of differences") {
  for (const uint64_t seed : {7, 8, 9}) check_world(seed, {{D, D}, {R, D, D, T}, {D, D, D}, {D, D, D, D}}, 5, 2);
}

TEST_CASE("derivatives of paths along a roof, from edge to edge, are those of differences") {
  GradientWorld world(11);
  std::mt19937_64 random(11);
  for (uint32_t surface = 0; surface < world.scene.surfaces.size(); ++surface) {
    const auto is_roof = [&](const Wedge& w) {
      return w.surface[0] != w.surface[1] && (w.plane[0] == surface || w.plane[1] == surface);
    };
    if (world.scene.surfaces[surface].normal.z < 0.99 || std::ranges::none_of(world.scene.wedges, is_roof)) continue;
    const auto edges = test::edges_where(world, is_roof);
    if (edges.size() != 4) continue;  // not that of the building with a corner
    test::add_random(world, {D, D}, 6, random, edges);
  }
  REQUIRE(world.sequences.size() == 18);
  test::check_worst(world, all_parameters);
}

TEST_CASE("derivatives of paths near and over a free end of an edge are those of differences") {
  GradientWorld world(12);
  mark_free_ends(world.scene);
  std::mt19937_64 random(12);
  const auto edges = test::edges_where(world, [](const Wedge& w) { return w.free_ends != 0; });
  size_t over = 0, near = 0;
  for (int tries = 0; tries < 20000 && (over < 6 || near < 6); ++tries) {
    GradientWorld one = world;
    one.sequences.clear();
    test::add_random(one, {D}, 1, random, edges);
    const uint32_t last = static_cast<uint32_t>(one.state.transmitters.size() - 1);
    const Wedge& wedge = world.scene.wedges[one.sequences[0][0].number];
    const auto tx = one.state.transmitters[last].position_m, rx = one.state.receivers[last].position_m;
    const double at = glm::dot(one.solve(one.sequences[0], tx, rx)->front() - wedge.start, wedge.along);
    const bool is_over = at < 1.001e-3 || at > wedge.length_m - 1.001e-3;
    if (!is_over && at > 0.5 && at < wedge.length_m - 0.5) continue;
    if (is_over ? over >= 6 : near >= 6) continue;
    ++(is_over ? over : near);
    world.add(one.sequences[0], tx, rx, random);
  }
  REQUIRE(over == 6);
  REQUIRE(near == 6);
  test::check_worst(world, all_parameters);
}

TEST_CASE("derivatives of antennas from pattern files are those of differences") {
  const test::TemporaryFolder folder;
  GradientWorld world(13);
  world.antennas = {folder.write("pattern.csv", pattern_text()).string()};
  std::mt19937_64 random(13);
  for (const auto& kinds : std::vector<std::vector<uint8_t>>{{}, {R}, {D}}) test::add_random(world, kinds, 5, random);
  test::check_worst(world, all_parameters);
}
