// SPDX-License-Identifier: Apache-2.0
// Tests of the two layouts: their structure, and a reference traversal of each against brute force.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "accel/layout.hpp"
#include "oracle.hpp"
#include "soups.hpp"
#include "wavetracer/device/bvh.h"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Both {
  Bvh2 two;
  Bvh8 eight;
  Both(const Soup& soup, bool splits) {
    BuildOptions options = BuildOptions::for_bvh2();
    options.spatial_splits = splits;
    two = make_bvh2(build_binary(soup, options), soup);
    options = BuildOptions::for_bvh8();
    options.spatial_splits = splits;
    eight = make_bvh8(build_binary(soup, options), soup);
  }
};

// Rays start from points in and around the soup, half towards points of a triangle (among them its corners and edges),
// half anywhere.
std::vector<OracleRay> rays_for(const Soup& soup, size_t count, uint32_t seed) {
  Box box;
  for (const AccelTriangle& triangle : soup)
    for (const auto& vertex : triangle.v) box.grow(vertex);
  if (soup.empty()) box = Box{{-1, -1, -1}, {1, 1, 1}};
  const double size = std::max({box.extent(0), box.extent(1), box.extent(2)});
  Random random(seed);
  std::vector<OracleRay> rays;
  while (rays.size() < count) {
    OracleRay ray;
    const size_t kind = rays.size() % 4;
    const double u = kind == 0 ? 0 : random(), v = kind <= 1 ? 0 : (1 - u) * random();
    const auto pick = static_cast<size_t>(random() * static_cast<double>(soup.size()));
    double length = 0;
    for (size_t axis = 0; axis < 3; axis++) {
      const double middle = box.center(static_cast<int>(axis));
      ray.origin[axis] = middle + size * (1.5 * random() - 0.75);
      double target = middle + size * (random() - 0.5);
      if (kind < 3 && !soup.empty()) {
        const auto& t = soup[pick].v;
        const double a = t[0][axis], b = t[1][axis], c = t[2][axis];
        target = a + u * (b - a) + v * (c - a);
      }
      ray.direction[axis] = target - ray.origin[axis];
      if (random() < 0.05) ray.direction[axis] = 0;
      length = std::max(length, std::abs(ray.direction[axis]));
    }
    if (!(length > 0)) continue;
    for (double& x : ray.direction) x /= length;
    rays.push_back(ray);
  }
  return rays;
}

// Returns the half areas of a BVH8's children times the cost of entering them, with all nodes below them, and the
// root's own cost.
double cost_of(const Bvh8& bvh, int32_t index, float node_cost) {
  const wt_bvh8_node& n = bvh.nodes.at(static_cast<size_t>(index));
  Box all;
  double cost = 0;
  for (int lane = 0; lane < 8; lane++) {
    const auto plane = [&](int row) { return n.planes[row].s[lane]; };
    const Box box{{plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}};
    if (box.empty()) continue;
    all.grow(box);
    const int32_t child = n.child[lane];
    cost += child >= 0 ? cost_of(bvh, child, node_cost) : (~child & ((1 << WT_LEAF_BITS) - 1)) * box.half_area();
  }
  return cost + static_cast<double>(node_cost) * all.half_area();
}

// Returns the cost of the simple collapse: replace the child of largest area by its two children until there are eight
// (I. Wald, C. Benthin, S. Boulos: Getting Rid of Packets, RT 2008). Leaves are the largest subtrees of max_leaf
// triangles.
double greedy_cost(const BinaryTree& tree, uint32_t index, const CollapseOptions& options) {
  const BinaryNode& node = tree.nodes[index];
  const auto is_leaf = [&](uint32_t i) { return tree.nodes[i].count <= options.max_leaf || tree.nodes[i].left == 0; };
  std::vector<uint32_t> children{index};
  for (size_t opened = index; opened < tree.nodes.size() && children.size() < 8;) {
    const auto at = std::find(children.begin(), children.end(), opened);
    *at = tree.nodes[opened].left;
    children.push_back(tree.nodes[opened].right);
    opened = tree.nodes.size();
    double largest = -1;
    for (const uint32_t child : children)
      if (!is_leaf(child) && tree.nodes[child].box.half_area() > largest) {
        largest = tree.nodes[child].box.half_area();
        opened = child;
      }
  }
  double cost = static_cast<double>(options.node_cost) * node.box.half_area();
  for (const uint32_t child : children)
    cost += is_leaf(child) ? (tree.nodes[child].count + 3) / 4 * tree.nodes[child].box.half_area()
                           : greedy_cost(tree, child, options);
  return cost;
}

}  // namespace

TEST_CASE("both layouts are sound, whatever the triangles") {
  for (const auto& [name, soup, solid] : all_soups()) {
    for (const bool splits : {false, true}) {
      const Both bvh(soup, splits);
      INFO(name, ", spatial splits ", splits);
      CHECK(faults(bvh.two, soup, !splits) == std::vector<std::string>{});
      CHECK(faults(bvh.eight, soup, !splits) == std::vector<std::string>{});
    }
  }
}

TEST_CASE("traversal finds what brute force finds") {
  for (const auto& [name, soup, solid] : all_soups()) {
    const std::vector<OracleRay> rays = rays_for(soup, soup.size() > 5000 ? 300 : 1000, 41);
    std::vector<OracleHit> expected;
    size_t hits = 0;
    for (const OracleRay& ray : rays) {
      expected.push_back(trace_brute_force(soup, ray));
      hits += expected.back().primitive != ~0u;
    }
    INFO(name, ": ", hits, " hits");
    CHECK((hits > rays.size() / 8) == solid);
    for (const bool splits : {false, true}) {
      const Both bvh(soup, splits);
      size_t wrong2 = 0, wrong8 = 0;
      for (size_t i = 0; i < rays.size(); i++) {
        wrong2 += !(trace(bvh.two, rays[i]) == expected[i]);
        wrong8 += !(trace(bvh.eight, rays[i]) == expected[i]);
      }
      INFO("spatial splits ", splits);
      CHECK(wrong2 == 0);
      CHECK(wrong8 == 0);
    }
  }
}

TEST_CASE("no ray enters an empty scene, and its root is an inner node") {
  const Both bvh({}, false);
  CHECK(bvh.two.nodes.size() == 1);
  CHECK(bvh.eight.nodes.size() == 1);
  CHECK(bvh.two.triangle_slots == 0);
  CHECK(bvh.two.max_depth == 1);
  CHECK(bvh.eight.max_depth == 1);
  for (const OracleRay& ray : rays_for({}, 100, 51)) {
    CHECK(trace(bvh.two, ray) == OracleHit{});
    CHECK(trace(bvh.eight, ray) == OracleHit{});
  }
}

TEST_CASE("the collapse is at least as good as opening the largest child first") {
  for (const auto& [name, soup, solid] : all_soups()) {
    const BinaryTree tree = build_binary(soup, BuildOptions::for_bvh8());
    if (tree.nodes.size() < 3) continue;
    for (const float node_cost : {0.3f, 1.0f, 3.0f}) {
      const CollapseOptions options{node_cost, 4};
      const double planned = cost_of(make_bvh8(tree, soup, options), 0, node_cost);
      const double greedy = greedy_cost(tree, 0, options);
      INFO(name, ", node cost ", node_cost);
      CHECK(planned <= greedy * 1.0001);  // plans are made in float
      if (soup.size() > 1000 && name != "2000 identical") CHECK(planned < 0.999 * greedy);
    }
  }
}

TEST_CASE("most slots of wide nodes are used and the tree is shallow") {
  const Both bvh(random_soup(20000, 100, 1, 61), false);
  const auto nodes = static_cast<double>(bvh.eight.nodes.size());
  const auto blocks = static_cast<double>(bvh.eight.blocks.size());
  CHECK((nodes - 1 + blocks) / (8 * nodes) > 0.5);  // children a slot; leaves have one block each
  CHECK(bvh.eight.max_depth <= 8);
}

TEST_CASE("a leaf too large for its reference is refused") {
  const Soup soup = identical_soup(16);
  BinaryTree tree;
  tree.nodes.push_back({Box{{0, 0, 1}, {3, 4, 1}}, 0, 0, 0, 16});
  for (uint32_t i = 0; i < 16; i++) tree.references.push_back(i);
  CHECK_THROWS_WITH_AS(make_bvh2(tree, soup), doctest::Contains("leaf of 16 triangles"), RuntimeError);
  CHECK_NOTHROW(make_bvh8(tree, soup));  // four blocks
}
