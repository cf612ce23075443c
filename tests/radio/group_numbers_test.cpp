// SPDX-License-Identifier: Apache-2.0
// Numbers of groups: by a map of each link, in the order of its paths.
#include "radio/group_numbers.hpp"

#include <doctest/doctest.h>

#include <map>
#include <random>

using namespace wavetracer;

TEST_CASE("group numbers are those of a map of each link; straight paths with one key are different waves") {
  std::mt19937 engine(7);
  const auto random = [&engine] { return static_cast<uint32_t>(engine()); };
  Paths paths;
  std::vector<device::wt_path_waves> waves;
  for (uint32_t link = 0; link < 300; ++link) {
    const uint32_t rows = 1 + random() % (link % 50 == 0 ? 2000 : 9);
    for (uint32_t i = 0; i < rows; ++i) {
      paths.tx.push_back(link / 7);
      paths.rx.push_back(link % 7);
      device::wt_path_waves& own = waves.emplace_back();
      own.bends = random() % 3 != 0;
      own.count = own.bends ? 1 + random() % most_groups : 1;
      for (uint32_t k = 0; k < own.count; ++k) {
        own.keys[k] = uint64_t{random() % 40} << 32 | k << 20;  // the same slot for all
        own.weights[k] = 0.1 + k;
      }
    }
  }
  std::vector<device::wt_path_wave> own;
  std::vector<device::wt_path_waves> shared;
  for (device::wt_path_waves& all : waves) {
    if (all.count == 1) all.weights[0] = 1;
    const size_t row = own.size();
    own.push_back({all.keys[0], all.count == 1 ? WT_ONE_WAVE : static_cast<uint32_t>(shared.size()), all.bends,
                   paths.tx[row], paths.rx[row]});
    if (all.count > 1) shared.push_back(all);
  }
  const GroupColumns found = number_groups(own, shared);
  std::map<std::pair<uint32_t, uint32_t>, std::map<std::pair<uint64_t, size_t>, uint32_t>> expected;
  std::map<std::pair<std::pair<uint32_t, uint32_t>, uint64_t>, size_t> straight;
  for (size_t row = 0; row < own.size(); ++row) {
    const std::pair link{paths.tx[row], paths.rx[row]};
    auto& numbers = expected[link];
    const size_t before = waves[row].bends ? 0 : straight[{link, waves[row].keys[0]}]++;
    const size_t apart = before == 0 ? 0 : row;
    for (size_t k = 0; k < most_groups; ++k) {
      if (k >= waves[row].count) {
        CHECK(found.group[row][k] == no_group);
        CHECK(found.weight[row][k] == 0);
        continue;
      }
      const auto number = static_cast<uint32_t>(numbers.size());
      REQUIRE(found.group[row][k] == numbers.try_emplace({waves[row].keys[k], apart}, number).first->second);
      CHECK(found.weight[row][k] == waves[row].weights[k]);
    }
  }
  CHECK(straight.size() > 100);
}
