// SPDX-License-Identifier: Apache-2.0
// Tests of the builder: structure, limits, cost, determinism, and the soups that break naive builders.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "accel/build.hpp"
#include "accel/split.hpp"
#include "oracle.hpp"
#include "soups.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

BuildOptions with_splits(BuildOptions options, bool spatial_splits) {
  options.spatial_splits = spatial_splits;
  return options;
}

}  // namespace

TEST_CASE("every tree is sound, whatever the triangles") {
  for (const auto& [name, soup, solid] : all_soups()) {
    for (const bool splits : {false, true}) {
      for (const BuildOptions& base : {BuildOptions::for_bvh2(), BuildOptions::for_bvh8()}) {
        const BuildOptions options = with_splits(base, splits);
        const BinaryTree tree = build_binary(soup, options);
        INFO(name, ", spatial splits ", splits, ", leaves of ", options.max_leaf);
        CHECK(faults(tree, soup, options) == std::vector<std::string>{});
        CHECK(tree.references.size() <= 2 * soup.size());
      }
    }
  }
}

TEST_CASE("a tree is the same for any number of threads") {
  const Soup soup = random_soup(60000, 1000, 30, 11);
  for (const bool splits : {false, true}) {
    const BuildOptions options = with_splits(BuildOptions::for_bvh2(), splits);
    BinaryTree first;
    for (const size_t threads : {1u, 2u, 4u, 7u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      const BinaryTree tree = build_binary(soup, options);
      if (first.nodes.empty()) first = tree;
      REQUIRE(tree.nodes.size() == first.nodes.size());
      CHECK(std::memcmp(tree.nodes.data(), first.nodes.data(), first.nodes.size() * sizeof(BinaryNode)) == 0);
      CHECK(tree.references == first.references);
    }
  }
}

TEST_CASE("depth stays within the bound that stacks rely on") {
  const Soup soup = geometric_soup(220, 110);
  BuildOptions options;
  options.max_leaf = 1;
  CHECK(faults(build_binary(soup, options), soup, options) == std::vector<std::string>{});
  CHECK(build_binary(soup, options).max_depth > 20);  // the tree is uneven here
  options.max_depth = 8;                              // and 2^8 >= 220
  const BinaryTree tree = build_binary(soup, options);
  CHECK(tree.max_depth == 8);
  CHECK(faults(tree, soup, options) == std::vector<std::string>{});
  options.max_depth = 7;
  CHECK_THROWS_WITH_AS(build_binary(soup, options), doctest::Contains("needs 8 levels"), RuntimeError);
}

TEST_CASE("options that cannot be met are refused") {
  BuildOptions options;
  options.max_leaf = 16;
  CHECK_THROWS_AS(build_binary(identical_soup(1), options), RuntimeError);
  options.max_leaf = 0;
  CHECK_THROWS_AS(build_binary(identical_soup(1), options), RuntimeError);
}

TEST_CASE("the SAH cost is that of its definition") {
  // Two unit triangles ten apart along x: root box 11 x 1 x 0, children 1 x 1 x 0.
  Soup soup;
  add(soup, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add(soup, {10, 0, 0}, {11, 0, 0}, {10, 1, 0});
  BuildOptions options;
  options.node_cost = 1;
  const BinaryTree tree = build_binary(soup, options);
  REQUIRE(tree.nodes.size() == 3);
  CHECK(sah_cost(tree, options) == doctest::Approx(1 + 2 * 1.0 / 11.0));
  // Together they would cost 2; so close that splitting does not pay, they stay one leaf.
  Soup close = soup;
  for (auto& vertex : close[1].v) vertex[0] -= 9.9f;
  CHECK(build_binary(close, options).nodes.size() == 1);
  CHECK(sah_cost(build_binary(close, options), options) == doctest::Approx(2));
  CHECK(sah_cost(build_binary({}, options), options) == 0);
}

TEST_CASE("the heuristic earns its keep") {
  const Soup soup = random_soup(5000, 100, 1, 21);
  const BuildOptions options;
  BuildOptions halving;
  halving.max_depth = 11;  // 2^11 * 4 >= 5000 > 2^10 * 4: no level left for anything but halves
  CHECK(sah_cost(build_binary(soup, options), options) < 0.9 * sah_cost(build_binary(soup, halving), halving));

  const Soup star = star_soup(400, 22);
  BuildOptions splits = with_splits(options, true);
  splits.duplication = 4;
  CHECK(sah_cost(build_binary(star, splits), splits) < 0.5 * sah_cost(build_binary(star, options), options));
}

TEST_CASE("the duplication budget is kept") {
  const Soup slivers = sliver_soup(400, 23);
  BuildOptions options = with_splits({}, true);
  for (const float duplication : {0.0f, 0.1f, 0.5f, 2.0f}) {
    options.duplication = duplication;
    const BinaryTree tree = build_binary(slivers, options);
    CHECK(static_cast<double>(tree.references.size()) <= 400 * (1 + static_cast<double>(duplication)));
    CHECK((tree.references.size() > 400) == (duplication > 0));
    CHECK(faults(tree, slivers, options) == std::vector<std::string>{});
  }
}

TEST_CASE("a cut triangle is covered by its pieces, tightly") {
  Soup soup;
  add(soup, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  const Box box{{0, 0, 0}, {4, 4, 0}};
  const accel::Pieces pieces = accel::cut(soup[0], box, 0, 1.0f);
  CHECK(pieces.left.contains(Box{{0, 0, 0}, {1, 4, 0}}));
  CHECK(Box{{0, 0, 0}, {1, 4, 0}}.contains(pieces.left));
  CHECK(pieces.right.contains(Box{{1, 0, 0}, {4, 3, 0}}));
  CHECK(Box{{1, 0, 0}, {4, 3.000001f, 0}}.contains(pieces.right));
  CHECK(accel::cut(soup[0], box, 0, 5.0f).right.empty());
  CHECK(accel::cut(soup[0], box, 0, -1.0f).left.empty());

  // Random cuts of random parts: points of the triangle inside the part are in one of its pieces.
  Random random(31);
  const Soup triangles = random_soup(300, 50, 40, 32);
  for (const AccelTriangle& triangle : triangles) {
    Box part;
    for (const auto& vertex : triangle.v) part.grow(vertex);
    for (int axis = 0; axis < 3; axis++) {
      const float plane = random.between(part.lower[axis], part.upper[axis]);
      const accel::Pieces halves = accel::cut(triangle, part, axis, plane);
      for (int sample = 0; sample < 50; sample++) {
        const double u = random(), v = (1 - u) * random();
        bool in_left = true, in_right = true, in_part = true;
        for (int k = 0; k < 3; k++) {
          const double x = triangle.v[0][k] + u * (static_cast<double>(triangle.v[1][k]) - triangle.v[0][k]) +
                           v * (static_cast<double>(triangle.v[2][k]) - triangle.v[0][k]);
          const auto inside = [&](const Box& b) { return x >= b.lower[k] && x <= b.upper[k]; };
          in_left = in_left && inside(halves.left);
          in_right = in_right && inside(halves.right);
          in_part = in_part && inside(part);
        }
        if (in_part) CHECK((in_left || in_right));
      }
      part = random() < 0.5 ? halves.left : halves.right;  // the next cut is made in the cut piece
      if (part.empty()) break;
    }
  }
}
