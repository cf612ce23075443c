// SPDX-License-Identifier: Apache-2.0
// Tests the table of heights that a launch gets for a world: streets, masts, rooms, drones, hills.
#include "simulation/launch_slopes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace wavetracer;

namespace {

// A square sheet of this side in the plane z = 0, with a box of points above it for the scene's size.
Scene ground(double side_m, double top_m = 30) {
  Scene out;
  const double h = side_m / 2;
  out.vertices = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
  out.triangles = {{0, 1, 2}, {0, 2, 3}};
  out.triangle_surface = out.triangle_object = {0, 0};
  out.objects = {"ground"};
  out.surface_triangles = {0, 1};
  out.surfaces.push_back({.lower = {-h, -h, 0}, .upper = {h, h, 0}, .triangle_count = 2});
  out.lower = {-h, -h, 0};
  out.upper = {h, h, top_m};
  return out;
}

WorldState world_of(const std::vector<glm::dvec3>& transmitters, const std::vector<glm::dvec3>& receivers) {
  WorldState out;
  for (const glm::dvec3& p : transmitters) out.transmitters.push_back({.position_m = p});
  for (const glm::dvec3& p : receivers) out.receivers.push_back({.position_m = p});
  for (uint32_t tx = 0; tx < transmitters.size(); ++tx)
    for (uint32_t rx = 0; rx < receivers.size(); ++rx) out.links.push_back({tx, rx});
  return out;
}

// No end is both; receivers listen or not.
Origins origins_of(const WorldState& world, bool listen = false) {
  return make_origins(std::vector<uint32_t>(world.transmitters.size(), no_end),
                      std::vector<uint32_t>(world.receivers.size(), no_end), listen);
}

std::vector<float> table_of(const SlopeTables& tables, uint32_t origin) {
  const size_t first = size_t{tables.of_origin[origin]} * height_table_size;
  return {tables.values.begin() + static_cast<ptrdiff_t>(first),
          tables.values.begin() + static_cast<ptrdiff_t>(first + height_table_size)};
}

std::vector<float> table(const Scene& scene, const WorldState& world, uint32_t origin = 0, bool listen = false) {
  return table_of(LaunchSlopes(Surroundings(scene), 0).tables(world, origins_of(world, listen)), origin);
}

// Returns the share of the directions between these z.
double share(const std::vector<float>& table, double from, double to) {
  const auto above = [&](double z) {
    for (uint32_t k = 1; k <= WT_HEIGHT_CELLS; ++k)
      if (table[k] <= z)
        return (k - 1 + (double{table[k - 1]} - z) / (double{table[k - 1]} - table[k])) / WT_HEIGHT_CELLS;
    return 1.0;
  };
  return above(from) - above(to);
}

}  // namespace

TEST_CASE("on a street half of the directions lie within a degree of the horizon, and most of them look down") {
  const std::vector<float> street = table(ground(800), world_of({{0, 0, 1.5}}, {{50, 3, 1.5}, {-80, 2, 1.7}}));
  CHECK(share(street, -0.0175, 0.0175) > 0.5);
  CHECK(share(street, -1, 0) == doctest::Approx(0.125 + 0.75 * 0.75).epsilon(0.01));
  CHECK(share(street, 0.5, 1) > 0.25 * 0.25);  // the uniform share is everywhere
}

TEST_CASE("a mast looks down to the street, and the street looks up to it") {
  const WorldState world = world_of({{0, 0, 30}}, {{50, 3, 1.5}});
  const std::vector<float> mast = table(ground(800), world), street = table(ground(800), world, 1, true);
  CHECK(share(mast, 0, 1) == doctest::Approx(0.125).epsilon(0.01));
  // Paths of 100 m to the reach of 1,131 m.
  CHECK(share(mast, -0.3, -0.02) > 0.35);
  CHECK(share(street, 0, 1) == doctest::Approx(0.125 + 0.75 * 0.5).epsilon(0.01));
}

TEST_CASE("receivers all around in elevation: a room and a drone have the uniform launch") {
  const auto uneven = [](const std::vector<float>& table) {
    double most = 0;  // the density of 20 bands against the uniform one
    for (int i = 0; i < 20; ++i) most = std::max(most, share(table, -1 + i / 10.0, -0.9 + i / 10.0) * 20);
    return most;
  };
  CHECK(uneven(table(ground(2, 3), world_of({{0, 0, 1.5}}, {{0.5, 0.5, 1}, {-0.5, 0.8, 2.5}}))) < 2);
  CHECK(uneven(table(ground(100, 150), world_of({{0, 0, 150}}, {{40, 3, 1.5}, {-20, 30, 1.5}}))) < 2);
  CHECK(uneven(table(ground(800), world_of({{0, 0, 1.5}}, {{40, 3, 1.5}}))) > 5);
}

TEST_CASE("a hall wider than high lies between the two") {
  const std::vector<float> hall = table(ground(40, 6), world_of({{0, 0, 3}}, {{15, 3, 1.5}}));
  const double horizon = share(hall, -0.1, 0.1);
  CHECK(horizon > 0.15);
  CHECK(horizon < 0.6);
}

TEST_CASE("links count by number: their order, and that of receivers, changes nothing") {
  const WorldState one = world_of({{0, 0, 1.5}}, {{50, 3, 1.5}, {10, 0, 30}, {20, 0, 6}, {30, 0, 1.6}});
  const WorldState other = world_of({{0, 0, 1.5}}, {{30, 0, 1.6}, {20, 0, 6}, {50, 3, 1.5}, {10, 0, 30}});
  CHECK(table(ground(800), one) == table(ground(800), other));
}

TEST_CASE("equal worlds of links share a table; what was known from earlier frames changes none") {
  const Scene scene = ground(800);
  const Surroundings around(scene);
  LaunchSlopes slopes(around, 0);
  const WorldState street = world_of({{0, 0, 1.5}, {5, 0, 1.5}}, {{50, 3, 1.5}}),
                   mast = world_of({{0, 0, 30}}, {{50, 3, 1.5}});
  const SlopeTables first = slopes.tables(street, origins_of(street));
  CHECK(first.of_origin[0] == first.of_origin[1]);
  const SlopeTables second = slopes.tables(mast, origins_of(mast)), third = slopes.tables(street, origins_of(street));
  CHECK(table_of(second, 0) == table(scene, mast));
  CHECK(table_of(third, 1) == table_of(first, 1));
}

TEST_CASE("heights are above the ground there: vehicles on a hill, a mast on a plateau, an end beside all ground") {
  const Scene scene = ground(800);
  const std::vector<float> street = table(scene, world_of({{0, 0, 1.5}}, {{50, 3, 1.5}}));
  WorldState hill = world_of({{0, 0, 201.5}}, {{50, 3, 201.5}});
  hill.instances.resize(2);
  for (uint32_t i = 0; i < 2; ++i) hill.instances[i].position_m.z = 200;
  hill.transmitters[0].instance = 0;
  hill.receivers[0].instance = 1;
  CHECK(table(scene, hill) == street);
  hill.transmitters[0].instance =
      no_instance;  // only the vehicle knows its own ground, and is asked: the lower one counts
  CHECK(share(table(scene, hill), -0.0175, 0) < share(street, -0.0175, 0));

  Scene plateau = ground(800);
  for (glm::dvec3& vertex : plateau.vertices) vertex.z = 100;
  plateau.surfaces[0].offset_m = 100;
  plateau.surfaces[0].lower.z = plateau.surfaces[0].upper.z = 100;
  plateau.lower.z = 0;  // something else is lower
  CHECK(table(plateau, world_of({{0, 0, 101.5}}, {{50, 3, 101.5}})) == street);
  CHECK(table(plateau, world_of({{4000, 0, 101.5}}, {{4050, 3, 101.5}})) != street);
}
