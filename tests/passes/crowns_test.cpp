// SPDX-License-Identifier: Apache-2.0
// crowns: its rows against a double loop over links and cells; cells: that they fill their volumes, inside of them.
#include "passes/crowns.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <tuple>

#include "passes/triangles.hpp"
#include "scene/volumes.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// A spheroid, a box and a cylinder, of which the box does not scatter.
Scene garden() {
  Scene scene;
  scene.materials = {{.name = "crown", .scattering = 0.5}, {.name = "hedge"}};
  for (Material& material : scene.materials) material.vegetation.emplace();
  scene.volumes = {
      {.shape = VolumeShape::spheroid, .centre = {10, -4, 6}, .half_size = {2.5, 2.5, 3.5}, .material = 0},
      {.shape = VolumeShape::box, .centre = {0, 9, 1}, .half_size = {4, 0.5, 1}, .yaw_rad = 0.4, .material = 1},
      {.shape = VolumeShape::cylinder, .centre = {-9, 2, 3}, .half_size = {3, 1, 2}, .yaw_rad = 1, .material = 0}};
  return scene;
}

}  // namespace

TEST_CASE("crowns: a row for every link and every cell") {
  const std::vector<Cell> cells = make_cells(garden(), 2, 1000);
  std::vector<EndState> transmitters(3), receivers(19);
  std::vector<Link> links;
  for (uint32_t t = 0; t < 3; ++t)
    for (uint32_t r = 0; r < 19; ++r)
      if ((t + 2 * r) % 3 != 0 && !(t == 1 && r < 16)) links.push_back({t, r});
  const RadioEnds ends = make_radio_ends(context(), transmitters, receivers, links);
  Crowns crowns(context(), cells, 40, 2);
  crowns(ends);  // it runs twice: nothing of the first run may remain
  const SolvedList& list = crowns(ends);
  REQUIRE(list.count == links.size() * cells.size());
  const auto headers = list.headers.read(0, list.count);
  const auto steps = list.sequences.read(0, 2 * size_t{list.count});
  const auto xyz = list.vertices.read(0, 3 * steps.size());
  std::set<std::tuple<uint32_t, uint32_t, uint32_t>> rows;
  double worst = 0;
  for (size_t i = 0; i < headers.size(); ++i) {
    CHECK(headers[i].depth == 1);
    CHECK(headers[i].blocked == 0);
    CHECK(headers[i].node == WT_NONE);
    CHECK(headers[i].quarters == WT_ALL_QUARTERS);
    CHECK((steps[2 * i] & WT_STEP_KIND) == WT_STEP_SCATTERING);
    const uint32_t cell = (steps[2 * i] & ~WT_STEP_KIND) - 40;
    REQUIRE(cell < cells.size());
    worst = std::max(worst, glm::distance(cells[cell].centre_m, {xyz[6 * i], xyz[6 * i + 1], xyz[6 * i + 2]}));
    rows.insert({headers[i].transmitter, headers[i].receiver, cell});
  }
  CHECK(worst == 0);
  std::set<std::tuple<uint32_t, uint32_t, uint32_t>> wanted;
  for (const Link& link : links)
    for (uint32_t cell = 0; cell < cells.size(); ++cell) wanted.insert({link.tx, link.rx, cell});
  CHECK(rows == wanted);
}

TEST_CASE("crowns: no links, and other ones than before") {
  const std::vector<Cell> cells = make_cells(garden(), 5, 1000);
  Crowns crowns(context(), cells, 0, 1);
  CHECK(crowns(make_radio_ends(context(), {EndState{}}, {EndState{}}, {})).count == 0);
  const SolvedList& list = crowns(make_radio_ends(context(), {EndState{}}, std::vector<EndState>(3), {{0, 2}}));
  REQUIRE(list.count == cells.size());
  CHECK(list.headers.read(0, 1).at(0).receiver == 2);
}

TEST_CASE("cells share the volume of what scatters, and are inside; of a coarse cut there is one at least") {
  const Scene scene = garden();
  const double exact[] = {4 * std::numbers::pi / 3 * 2.5 * 2.5 * 3.5, 0, 2 * std::numbers::pi * 3 * 1 * 2};
  for (const double cell_m : {100.0, 5.0, 1.0, 0.25}) {
    CAPTURE(cell_m);
    double found[3] = {0, 0, 0};
    for (const Cell& cell : make_cells(scene, cell_m, 1'000'000)) {
      const Volume& volume = scene.volumes[cell.volume];
      const glm::dvec3 d = cell.centre_m - volume.centre;
      const double c = std::cos(volume.yaw_rad), s = std::sin(volume.yaw_rad);
      const glm::dvec3 q = glm::dvec3(c * d.x + s * d.y, c * d.y - s * d.x, d.z) / volume.half_size;
      const double round = q.x * q.x + q.y * q.y;
      CHECK((volume.shape == VolumeShape::spheroid ? round + q.z * q.z : std::max(round, std::abs(q.z))) < 1);
      CHECK(cell.volume_m3 < 1.5 * cell_m * cell_m * cell_m);
      found[cell.volume] += cell.volume_m3;
    }
    for (int i = 0; i < 3; ++i) CHECK(found[i] == doctest::Approx(exact[i]).epsilon(1e-12));
  }
  CHECK_THROWS_WITH_AS(make_cells(scene, 0.001, 1'000'000), doctest::Contains("trace.tile_m = 0.001 cuts"),
                       ConfigError);

  // A thin mesh across its box.
  RawMesh hedge{"hedge", "hedge.ply", {}, {}, 0};
  for (const double z : {0.0, 2.0})
    for (const auto& [x, y] : std::vector<std::array<double, 2>>{{0, 0.3}, {0.3, 0}, {20, 19.7}, {19.7, 20}})
      hedge.vertices.emplace_back(x, y, z);
  hedge.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (uint32_t i = 0; i < 4; ++i) {
    const uint32_t j = (i + 1) % 4;
    hedge.triangles.push_back({i, j, 4 + j});
    hedge.triangles.push_back({i, 4 + j, 4 + i});
  }
  Scene thin = scene;
  thin.volumes = mesh_volumes(hedge, 0);
  const std::vector<Cell> cells = make_cells(thin, 4, 1'000'000);
  double volume_m3 = 0;
  for (const Cell& cell : cells) {
    CHECK(std::abs(cell.centre_m.x - cell.centre_m.y) < 0.3);
    volume_m3 += cell.volume_m3;
  }
  CHECK(cells.size() > 4);
  CHECK(volume_m3 == doctest::Approx(2 * (20.0 * 20.0 - 19.7 * 19.7 - 0.3 * 0.3)).epsilon(1e-9));
}
