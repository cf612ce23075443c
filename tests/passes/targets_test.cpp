// SPDX-License-Identifier: Apache-2.0
// targets: its rows against a double loop over links and points, with points that are absent, ends that ride with a
// point, lit sides and a floor; the points of a frame as records; rows over bodies that are targets.
#include "passes/targets.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "passes/triangles.hpp"
#include "radio/world_records.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Points 0 to 4; point 2 is absent, points 3 and 4 ride on vehicle 7.
WorldState five_points() {
  WorldState out;
  for (uint32_t i = 0; i < 5; ++i)
    out.targets.push_back({.position_m = {1.5 * i, 2 - 0.3 * i, 0.7},
                           .velocity_m_s = {0.1 * i, 3, -1},
                           .instance = i > 2 ? 7 : no_instance,
                           .law = 10 + i,
                           .present = i != 2});
  out.targets[1].rotation = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
  return out;
}

// Two level triangles, 0 at z = 0.7 and 1 at z = 2, whose normals point upwards.
DeviceScene two_floors() {
  const auto level = [](double z) {
    return Corners{glm::dvec3(-9, -9, z), glm::dvec3(20, -9, z), glm::dvec3(0, 20, z)};
  };
  return make_device_scene(context(), scene_of_triangles({level(0.7), level(2)}), false);
}

}  // namespace

TEST_CASE("targets: a row for every link and every point") {
  std::vector<EndState> transmitters(3), receivers(19);
  transmitters[1].instance = 7;
  receivers[18].instance = 7;
  receivers[17].instance = 6;
  std::vector<Link> links;
  for (uint32_t t = 0; t < 3; ++t)
    for (uint32_t r = 0; r < 19; ++r)
      if ((t + 2 * r) % 3 != 0) links.push_back({t, r});
  const RadioEnds ends = make_radio_ends(context(), transmitters, receivers, links);
  const WorldState world = five_points();
  TargetRows targets(context(), 5, 2);
  targets.place(world);
  const DeviceScene scene = two_floors();
  targets(scene, ends);  // it runs twice: nothing of the first run may remain
  const SolvedList& list = targets(scene, ends);
  REQUIRE(list.count == links.size() * 5);
  const auto headers = list.headers.read(0, list.count);
  const auto steps = list.sequences.read(0, 2 * size_t{list.count});
  const auto xyz = list.vertices.read(0, 3 * steps.size());
  std::set<std::tuple<uint32_t, uint32_t, uint32_t>> rows, wanted;
  for (size_t i = 0; i < headers.size(); ++i) {
    CHECK(headers[i].depth == 1);
    CHECK(headers[i].node == WT_NONE);
    CHECK(headers[i].quarters == WT_ALL_QUARTERS);
    CHECK((steps[2 * i] & WT_STEP_KIND) == WT_STEP_TARGET);
    const uint32_t point = steps[2 * i] & ~WT_STEP_KIND;
    REQUIRE(point < 5);
    CHECK(glm::distance(world.targets[point].position_m, {xyz[6 * i], xyz[6 * i + 1], xyz[6 * i + 2]}) == 0);
    if (!headers[i].blocked) CHECK(rows.insert({headers[i].transmitter, headers[i].receiver, point}).second);
  }
  for (const Link& link : links)
    for (const uint32_t point : {0u, 1u, 3u, 4u})
      if (point < 3 || (link.tx != 1 && link.rx != 18)) wanted.insert({link.tx, link.rx, point});
  CHECK(rows == wanted);
}

TEST_CASE("targets: no links, and other ones than before") {
  TargetRows targets(context(), 5, 1);
  targets.place(five_points());
  const DeviceScene scene = two_floors();
  CHECK(targets(scene, make_radio_ends(context(), {EndState{}}, {EndState{}}, {})).count == 0);
  const SolvedList& list = targets(scene, make_radio_ends(context(), {EndState{}}, std::vector<EndState>(3), {{0, 2}}));
  REQUIRE(list.count == 5);
  for (const wt_solved& row : list.headers.read(0, 5)) CHECK(row.receiver == 2);
}

TEST_CASE("targets: records of points are turned and move as the points do") {
  const WorldState world = five_points();
  const std::vector<wt_target_point> records = target_records(world);
  REQUIRE(records.size() == 5);
  // Ahead in the axes of point 1 is along y of the scene.
  CHECK(records[1].rotation[0] == 0);
  CHECK(records[1].rotation[3] == 1);
  CHECK(records[1].rotation[1] == -1);
  CHECK(records[4].velocity[0] == 0.4);
  CHECK(records[4].law == 14);
  CHECK(records[4].instance == 7);
  CHECK(records[2].present == 0);
}

TEST_CASE("targets: with a floor and with sides only rows that may be seen are written, and weak ones are counted") {
  Random random(7);
  std::vector<EndState> transmitters(40), receivers(70);
  for (std::vector<EndState>* ends : {&transmitters, &receivers})
    for (EndState& end : *ends) end.position_m = random.in_cube(6);
  receivers[3].instance = 7;
  std::vector<Link> links;
  for (uint32_t t = 0; t < transmitters.size(); ++t)
    for (uint32_t r = 0; r < receivers.size(); ++r) links.push_back({t, r});
  WorldState world = five_points();
  world.targets[0].surface = 0;  // lit from above alone
  world.targets[0].lit_above = true;
  world.targets[1].surface = 1;  // from both sides
  world.targets[1].lit_above = world.targets[1].lit_below = true;
  const std::vector<double> powers{3, 2, 1, 0.5, 4};
  constexpr double floor = 2e-3;
  TargetRows targets(context(), 5, 1, TargetLimits{.floor = floor, .powers = powers, .sides = true});
  targets.place(world);
  const SolvedList& list = targets(two_floors(), make_radio_ends(context(), transmitters, receivers, links));
  std::set<std::tuple<uint32_t, uint32_t, uint32_t>> rows, wanted;
  uint64_t weak = 0;
  const auto headers = list.headers.read(0, list.count);
  const auto steps = list.sequences.read(0, list.count);
  for (size_t i = 0; i < headers.size(); ++i) {
    CHECK(headers[i].blocked == 0);
    CHECK(rows.insert({headers[i].transmitter, headers[i].receiver, steps[i] & ~WT_STEP_KIND}).second);
  }
  for (const auto& [tx, rx] : links)
    for (uint32_t point = 0; point < 5; ++point) {
      const glm::dvec3 a = transmitters[tx].position_m, b = receivers[rx].position_m;
      const double height_m = point == 0 ? 0.7 : 2;
      const bool up = a.z > height_m, same = up == (b.z > height_m);
      if (point == 2 || (point > 2 && rx == 3) || (point < 2 && !same) || (point == 0 && !up)) continue;
      const glm::dvec3 p = world.targets[point].position_m;
      const double gain = powers[point] / std::pow(glm::distance(a, p) * glm::distance(b, p), 2);
      if (gain < floor)
        ++weak;
      else
        wanted.insert({tx, rx, point});
    }
  CHECK(rows == wanted);
  CHECK(targets.weak() == weak);
  CHECK(weak > 1000);
  CHECK(rows.size() > 1000);
}

TEST_CASE("target_bodies: rows with a mirror, an edge or a tile on a body are marked, others are not") {
  // Surface 0 is static, surfaces 1 and 2 are those of instances 0 and 1; edge 0 and tile 0 are on instance 1.
  std::vector<wt_exact_surface> surfaces(3);
  surfaces[0].instance = WT_NONE;
  surfaces[1].instance = 0;
  surfaces[2].instance = 1;
  std::vector<wt_wedge> edges(1);
  edges[0].instance = 1;
  DeviceScene scene = two_floors();
  scene.exact_surfaces = context().buffer(surfaces, "surfaces");
  const auto wedges = context().buffer(edges, "edges");
  const auto tiles = context().buffer(std::vector<uint32_t>{2}, "tiles");
  const std::vector<std::vector<uint32_t>> rows{{},
                                                {0},
                                                {1},
                                                {2},
                                                {0, 2},
                                                {1, WT_STEP_TARGET | 2},
                                                {WT_STEP_DIFFRACTION | 0},
                                                {0, WT_STEP_SCATTERING | 0},
                                                {WT_STEP_SCATTERING | 1},  // a cell
                                                {WT_STEP_TRANSMISSION | 2},
                                                {2, WT_STEP_TARGET | 1},  // a bounce within the body
                                                {2, WT_STEP_TARGET | 0}};
  const std::vector<bool> wanted{false, false, false, true, true, false, true, true, false, false, false, true};
  std::vector<wt_solved> headers(rows.size());
  std::vector<uint32_t> steps(2 * rows.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    headers[i].depth = static_cast<uint32_t>(rows[i].size());
    std::copy(rows[i].begin(), rows[i].end(), steps.begin() + static_cast<ptrdiff_t>(2 * i));
  }
  SolvedList list;
  list.max_depth = 2;
  list.count = static_cast<uint32_t>(rows.size());
  list.headers = context().buffer(headers, "headers");
  list.sequences = context().buffer(steps, "steps");
  Counters counters(context());
  WorldState world;  // its second point is a piece of instance 1
  world.targets.resize(3);
  world.targets[1].instance = 1;
  world.targets[1].surface = 2;
  TargetRows points(context(), 3, 2);
  points.place(world);
  TargetBodies bodies(context(), {0, 1});
  bodies(scene, list, counters, StepTables{&wedges, &tiles, nullptr}, points);
  const auto marked = list.headers.read(0, list.count);
  for (size_t i = 0; i < rows.size(); ++i) CHECK((marked[i].blocked != 0) == wanted[i]);
}
