// SPDX-License-Identifier: Apache-2.0
// path_groups: waves of random paths over edges, on the device as on the host; and what is known at shadow boundaries.
#include "passes/path_groups.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "passes/solved_rows.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/device/path_groups.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr double wave_m = 0.125;
constexpr uint32_t edge_count = 20, surface_count = 60, deepest = 5;

// Edge `number` along z, with faces 2 `number` and 2 `number` + 1, of which the first is the half plane y = 0, x > 0.
wt_wedge upright(uint32_t number, double exterior_rad) {
  return {.start = {0, 0, -50},
          .along = {0, 0, 1},
          .face = {1, 0, 0},
          .normal = {0, 1, 0},
          .length = 100,
          .exterior = exterior_rad,
          .cosine = std::cos(exterior_rad),
          .sine = std::sin(exterior_rad),
          .surfaces = {2 * number, 2 * number + 1},
          .planes = {2 * number, 2 * number + 1},
          .instance = WT_NONE,
          .free_ends = 0};
}

// Two neighbours each lie in one plane.
std::vector<uint32_t> planes() {
  std::vector<uint32_t> out;
  for (uint32_t surface = 0; surface < surface_count; ++surface) out.push_back(surface / 2 * 2);
  return out;
}

// Returns the groups that the device finds of rows, each of which has a link of its own. expected: rows that are read
// before it is known how many there are.
Paths on_device(const std::vector<PathRow>& rows, const std::vector<wt_wedge>& wedges, uint32_t expected) {
  const auto count = static_cast<uint32_t>(rows.size());
  const std::vector<uint32_t> alone(count, WT_NONE);
  Distinct distinct(context(), alone, alone);
  RowList list;
  list.places = count;
  std::vector<uint32_t> number, before;
  Paths paths;
  for (uint32_t i = 0; i < count; ++i) {
    number.push_back(2 * i);
    before.push_back(i);
    paths.tx.push_back(i);
    paths.rx.push_back(i);
  }
  paths.frame.assign(count, 0);
  paths.delay_s.assign(count, 0);
  list.rows = context().buffer(number, "rows");
  list.counts = context().buffer(before, "rows before");
  const gpu::Buffer<wt_wedge> edges = context().buffer(wedges, "edges");
  PathGroups groups(context(), planes(), deepest, wave_m);
  const RadioEnds ends = ends_of(rows);
  const SolvedList visible = upload_rows(rows, deepest);
  groups(&edges, ends, visible, distinct, list, count);
  groups.begin_read(expected);
  context().finish();
  groups.number(count);
  groups.set(paths);
  return paths;
}

PathRow over_edge(const glm::dvec3& from, const glm::dvec3& to) {
  PathRow row;
  row.from = from;
  row.to = to;
  row.steps = {WT_STEP_DIFFRACTION};
  row.points = {{0, 0, 0}};
  return row;
}

glm::dvec3 at(double degrees) {
  const double turn = degrees * std::acos(-1.0) / 180;
  return 10.0 * glm::dvec3(std::cos(turn), std::sin(turn), 0);
}

}  // namespace

TEST_CASE("path_groups: random paths have the host's waves, whose squares add up to 1") {
  Random random(41);
  std::vector<wt_wedge> wedges;
  for (uint32_t i = 0; i < edge_count; ++i) wedges.push_back(upright(i, random.between(3.3, 6.2)));
  const auto place = [&] { return glm::dvec3(random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)); };
  const uint32_t kinds[] = {WT_STEP_REFLECTION, WT_STEP_TRANSMISSION, WT_STEP_DIFFRACTION, WT_STEP_DIFFRACTION};
  std::vector<PathRow> rows(2000);
  for (PathRow& row : rows) {
    row.from = place();
    row.to = place();
    for (uint32_t k = 0, depth = random.below(deepest + 1); k < depth; ++k) {
      row.steps.push_back(kinds[random.below(4)] | random.below(edge_count));
      row.points.push_back(place());
    }
  }
  const Paths paths = on_device(rows, wedges, 2000);
  const Paths more_than_expected = on_device(rows, wedges, 1000);
  CHECK(more_than_expected.group == paths.group);
  CHECK(more_than_expected.group_weight == paths.group_weight);
  size_t many = 0;
  for (uint32_t i = 0; i < rows.size(); ++i) {
    CAPTURE(i);
    const double from[3] = {rows[i].from.x, rows[i].from.y, rows[i].from.z};
    std::vector<double> xyz;
    for (const glm::dvec3& p : rows[i].points) xyz.insert(xyz.end(), {p.x, p.y, p.z});
    const device::wt_path path{
        xyz.data(), rows[i].steps.data(),    i,         i, static_cast<uint32_t>(rows[i].steps.size()),
        0,          device::wt_vector(from), rows[i].to};
    device::wt_waves waves;
    const uint32_t bends = device::wt_waves_of(&path, wedges.data(), planes().data(), wave_m, &waves);
    device::wt_path_waves expected{};
    device::wt_write_waves(&waves, bends, &expected);
    double squares = 0;
    for (size_t k = 0; k < most_groups; ++k) {
      CHECK(paths.group[i][k] == (k < expected.count ? static_cast<uint32_t>(k) : no_group));
      CHECK(paths.group_weight[i][k] == (k < expected.count ? expected.weights[k] : 0));
      squares += paths.group_weight[i][k] * paths.group_weight[i][k];
    }
    CHECK(squares == doctest::Approx(1).epsilon(1e-12));
    many += expected.count == most_groups;
  }
  CHECK(many > 100);
}

TEST_CASE("path_groups: at a boundary a diffracted wave is the one that ends there, and far from it another") {
  const std::vector<wt_wedge> wedges{upright(0, 1.5 * std::acos(-1.0))};
  // The source is at 60 degrees from face 0: its reflection there ends at 120 degrees, and the line of sight at 240.
  const std::vector<PathRow> rows{over_edge(at(60), at(240)), over_edge(at(60), at(120)), over_edge(at(60), at(180)),
                                  over_edge(at(60), at(242))};
  const Paths paths = on_device(rows, wedges, 4);
  for (const size_t boundary : {0u, 1u}) {
    CHECK(paths.group_weight[boundary][0] == doctest::Approx(1).epsilon(1e-9));
    CHECK(std::abs(paths.group_weight[boundary][1]) < 1e-6);
  }
  CHECK(paths.group[2] == only_group(0));
  CHECK(paths.group_weight[2][0] == 1);
  // 2 degrees behind the boundary the way over the edge is 10 m (1 - cos 1 degree) longer, 24 thousandths of a wave.
  const double part = 20 * (1 - std::cos(std::acos(-1.0) / 180)) / 2 / wave_m / WT_MOST_DETOUR;
  CHECK(paths.group_weight[3][0] == doctest::Approx((1 - part * part) * (1 - part * part)).epsilon(1e-3));
}
