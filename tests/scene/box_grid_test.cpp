// SPDX-License-Identifier: Apache-2.0
// Compares BoxGrid with a brute force search, for points inside, beside and far from the boxes, and for boxes of no
// thickness.
#include "scene/box_grid.hpp"

#include <doctest/doctest.h>

#include <random>
#include <set>

using namespace wavetracer;

namespace {

std::set<uint32_t> found_by_grid(const BoxGrid& grid, const glm::dvec3& p, double margin_m) {
  std::set<uint32_t> out;
  grid.at(p, margin_m, [&](uint32_t i) { CHECK(out.insert(i).second); });
  return out;
}

std::set<uint32_t> found_one_by_one(const std::vector<SceneBox>& boxes, const glm::dvec3& p, double margin_m) {
  std::set<uint32_t> out;
  for (uint32_t i = 0; i < boxes.size(); ++i)
    if (glm::all(glm::greaterThanEqual(p, boxes[i].lower - margin_m)) &&
        glm::all(glm::lessThanEqual(p, boxes[i].upper + margin_m)))
      out.insert(i);
  return out;
}

}  // namespace

TEST_CASE("the boxes at a point are those of a search one by one") {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  size_t found = 0;
  for (const size_t count : {0, 1, 4, 5, 1000}) {
    CAPTURE(count);
    std::vector<SceneBox> boxes;
    for (size_t i = 0; i < count; ++i) {
      const glm::dvec3 lower{between(-50, 50), between(-50, 50), between(0, 5)};
      const double flat = i % 3 == 0 ? 0 : 1;
      boxes.push_back({lower, lower + glm::dvec3{flat * between(0, 9), between(0, i % 50 == 0 ? 80 : 9), 3}});
    }
    const BoxGrid grid(boxes);
    for (int k = 0; k < 500; ++k) {
      glm::dvec3 p{between(-55, 55), between(-55, 55), between(-1, 9)};
      if (count > 0 && k % 2 == 0) p.x = boxes[static_cast<size_t>(k) % count].lower.x;  // on a side
      const double margin_m = k % 3 == 0 ? 0 : k % 3 == 1 ? 1e-3 : 4;  // the last reaches into several cells
      const std::set<uint32_t> expected = found_one_by_one(boxes, p, margin_m);
      CHECK(found_by_grid(grid, p, margin_m) == expected);
      found += expected.size();
    }
  }
  CHECK(found > 100);
}

TEST_CASE("boxes that are all one are found, all of them") {
  const std::vector<SceneBox> boxes(100, {{0, 0, 0}, {1, 1, 1}});
  CHECK(found_by_grid(BoxGrid(boxes), {0.5, 0.5, 1}, 0).size() == 100);
  CHECK(found_by_grid(BoxGrid(boxes), {0.5, 0.5, 1.01}, 1e-3).empty());
}
