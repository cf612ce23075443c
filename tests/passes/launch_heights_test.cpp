// SPDX-License-Identifier: Apache-2.0
// Tables of heights against the closed forms of the densities that they stand for.
#include "passes/launch_heights.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace wavetracer;

namespace {

void check_falls(const std::vector<float>& table) {
  REQUIRE(table.size() == height_table_size);
  CHECK(table.front() == 1);
  CHECK(table.back() == -1);
  size_t rises = 0;
  for (size_t i = 1; i < table.size(); ++i) rises += !(table[i] < table[i - 1]);
  CHECK(rises == 0);
}

}  // namespace

TEST_CASE("without shares, with uniform ones alone, and with z0 = 1 all heights are alike") {
  const HeightShare street[] = {{1, 0.01, true}, {3, 0.01, false}}, even[] = {{2, 1, true}, {2, 1, false}};
  for (const std::vector<float>& table : {height_table({}, 0.25), height_table(street, 1), height_table(even, 0.25)}) {
    check_falls(table);
    double worst = 0;
    for (uint32_t k = 0; k <= WT_HEIGHT_CELLS; ++k)
      worst = std::max(worst, std::abs(table[k] - (1 - 2.0 * k / WT_HEIGHT_CELLS)));
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("one share on both sides is the rational map z = u / (1 + k (1 - |u|))") {
  for (const double z0 : {0.5, 0.1, 0.01, 1.0 / 300}) {
    CAPTURE(z0);
    const HeightShare both[] = {{1, z0, true}, {1, z0, false}};
    const std::vector<float> table = height_table(both, 0);
    check_falls(table);
    const double k = 1 / z0 - 1;
    double worst = 0;  // relative to z0, in units of which directions near the horizon are spread
    for (uint32_t i = 0; i <= WT_HEIGHT_CELLS; ++i) {
      const double u = 1 - 2.0 * i / WT_HEIGHT_CELLS, z = u / (1 + k * (1 - std::abs(u)));
      worst = std::max(worst, std::abs(table[i] - z) / (std::abs(z) + z0));
    }
    CHECK(worst < 1e-3);
  }
}

TEST_CASE("a mixture: as many directions up and down, and as many near the horizon, as its shares say") {
  const HeightShare shares[] = {{1, 0.1, true}, {2, 0.01, false}, {1, 0.2, false}};
  const std::vector<float> table = height_table(shares, 0.25);
  check_falls(table);
  // The function returns the share of a side between the horizon and z; the other one that of the uniform part.
  const auto below = [](double z0, double z) { return z / (z0 + (1 - z0) * z); };
  const auto above = [&](double z) {
    return z >= 0 ? 0.25 * (1 - z) / 2 + 0.75 * 0.25 * (1 - below(0.1, z))
                  : 0.25 * (1 - z) / 2 + 0.75 * (0.25 + 0.5 * below(0.01, -z) + 0.25 * below(0.2, -z));
  };
  double worst = 0;
  for (uint32_t k = 0; k <= WT_HEIGHT_CELLS; ++k)
    worst = std::max(worst, std::abs(above(table[k]) - static_cast<double>(k) / WT_HEIGHT_CELLS));
  CHECK(worst < 1e-4);
}
