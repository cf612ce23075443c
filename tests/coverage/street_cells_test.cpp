// SPDX-License-Identifier: Apache-2.0
// Cells on streets against the distance from every segment of every street.
#include "coverage/street_cells.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

using namespace wavetracer;
using namespace wavetracer::coverage;

namespace {

Map made_map(uint32_t columns, uint32_t rows) {
  Map map{.grid = "g", .columns = columns, .rows = rows, .first_m = {-40, 13}, .step_m = {3, 2.5}};
  map.cells.assign(size_t{columns} * rows, {.path_gain_db = -80, .paths = 2});
  return map;
}

double from_segment_m(double x, double y, const glm::dvec3& a, const glm::dvec3& b) {
  double least = INFINITY;
  for (int i = 0; i <= 20000; ++i) {
    const glm::dvec3 p = a + (i / 20000.0) * (b - a);
    least = std::min(least, std::hypot(p.x - x, p.y - y));
  }
  return least;
}

}  // namespace

TEST_CASE("the cells on streets are those near a centre line") {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> place(-60, 80), width(1, 14);
  for (int repeat = 0; repeat < 6; ++repeat) {
    const Map map = made_map(31, 19);
    std::vector<Street> streets;
    for (int i = 0; i < 2; ++i) {
      Street street{{}, width(random)};
      for (int k = 0; k < 3; ++k) street.centre_m.push_back({place(random), place(random), 7});
      streets.push_back(street);
    }
    const std::vector<bool> on = cells_on_streets(map, streets);
    REQUIRE(on.size() == map.cells.size());
    for (size_t cell = 0; cell < on.size(); ++cell) {
      double beyond_m = INFINITY;  // distance from the nearest edge of a street; below 0 inside
      for (const Street& street : streets)
        for (size_t k = 0; k < 2; ++k)
          beyond_m = std::min(beyond_m,
                              from_segment_m(map.x_m(cell), map.y_m(cell), street.centre_m[k], street.centre_m[k + 1]) -
                                  0.5 * street.width_m);
      if (std::abs(beyond_m) > 0.01) CHECK(on[cell] == (beyond_m < 0));
    }
  }
}

TEST_CASE("streets that miss the map, points, and cells that lose their values") {
  Map map = made_map(4, 3);
  CHECK(cells_on_streets(map, std::vector<Street>{}) == std::vector<bool>(12, false));
  const std::vector<Street> away{{{{500, 500, 0}, {900, 500, 0}}, 20}, {{{-400, 15, 0}, {-300, 15, 0}}, 5}};
  CHECK(cells_on_streets(map, away) == std::vector<bool>(12, false));
  const std::vector<Street> point{{{{-37, 15.5, 0}, {-37, 15.5, 0}}, 1}};  // the middle of cell 1,1
  std::vector<bool> expected(12, false);
  expected[5] = true;
  CHECK(cells_on_streets(map, point) == expected);
  map.chances.assign(12, {.samples = 3});
  keep_streets(map, expected);
  CHECK(map.only_streets);
  CHECK(map.reached_cells() == 1);
  CHECK(map.reached(5));
  CHECK(map.cells[5].path_gain_db == -80);
  CHECK(std::isnan(map.cells[4].path_gain_db));
  CHECK(map.chances[5].samples == 3);
  CHECK(map.chances[4].samples == 0);
}
