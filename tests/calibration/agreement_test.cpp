// SPDX-License-Identifier: Apache-2.0
// Statistics of a few pairs, worked out by hand, and blocks of random places.
#include "calibration/agreement.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "check_contains.hpp"

using namespace wavetracer::calibration;
using wavetracer::test::check_contains;

TEST_CASE("equal values share the mean of their ranks") {
  CHECK(ranks_of(std::vector<double>{3, 1, 2}) == std::vector<double>{3, 1, 2});
  CHECK(ranks_of(std::vector<double>{5, 5, 1, 5}) == std::vector<double>{3, 3, 1, 3});
}

TEST_CASE("statistics leave points without a path out, and count them") {
  const std::vector<LevelPair> pairs{{-80, -83}, {-90, -91}, {-100, -101}, {-95, -INFINITY}};
  const Statistics of = statistics_of(pairs);
  CHECK(of.points == 4);
  CHECK(of.with_a_path == 3);
  CHECK(of.offset_db == doctest::Approx(5.0 / 3));
  CHECK(of.sigma_db == doctest::Approx(std::sqrt(4.0 / 3)));  // 3, 1 and 1 about 5/3
  CHECK(of.spearman == doctest::Approx(1));
  const Statistics reversed = statistics_of(std::vector<LevelPair>{{1, 3}, {2, 2}, {3, 1}});
  CHECK(reversed.spearman == doctest::Approx(-1));
  const Statistics one = statistics_of(std::vector<LevelPair>{{1, 3}});
  CHECK(std::isnan(one.sigma_db));
  CHECK(std::isnan(statistics_of(std::vector<LevelPair>{{1, 3}, {2, 3}}).spearman));
}

TEST_CASE("blocks have the same number of places, and no two of them overlap along a street") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> along(0, 100), across(0, 5);
  std::vector<double> x, y;
  for (int i = 0; i < 103; ++i) {
    x.push_back(along(random));
    y.push_back(across(random));
  }
  const std::vector<unsigned> blocks = spatial_blocks(x, y, 4);
  std::vector<double> least(4, INFINITY), most(4, -INFINITY);
  std::vector<int> count(4);
  for (size_t i = 0; i < blocks.size(); ++i) {
    REQUIRE(blocks[i] < 4);
    ++count[blocks[i]];
    least[blocks[i]] = std::min(least[blocks[i]], x[i]);
    most[blocks[i]] = std::max(most[blocks[i]], x[i]);
  }
  for (int block = 0; block < 4; ++block) {
    CHECK(count[block] >= 25);
    CHECK(count[block] <= 26);
    if (block > 0) CHECK(most[block - 1] <= least[block]);
  }
}

TEST_CASE("a fit that predicts worse than the configuration is said to do so") {
  Agreement all{"all", {50, 50, 1.7, 2.06, 0.9}, {50, 50, 0, 2.04, 0.9}, {50, 50, -0.2, 2.58, 0.8}};
  check_contains(held_out_warning(all), "(2.58 dB against 2.06 dB): the data do not support this fit");
  all.held_out.sigma_db = 2.1;
  CHECK(held_out_warning(all).empty());
  all.held_out = {};
  CHECK(held_out_warning(all).empty());
}
