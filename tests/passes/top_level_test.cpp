// SPDX-License-Identifier: Apache-2.0
// top_level: the tree that the device builds over instances; plain code checks its content, and hits of rays compare it
// with the host's tree.
#include "passes/top_level.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <set>

#include "passes/traffic.hpp"
#include "wavetracer/device/moving.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

struct Span {
  glm::dvec3 lower, upper;
};

// Walks the top level in DeviceScene::moving from its root.
class Walk {
 public:
  Walk(const Traffic& traffic, const DeviceScene& scene) : traffic_(traffic), moving_(scene.moving.read()) {
    visit(0, 1);
  }

  std::multiset<uint32_t> instances;  // those of the leaves
  size_t deepest = 0;                 // inner nodes on the longest way down
  double half_areas = 0;              // sum over the boxes of inner nodes except the root
  double worst_gap_m = 0;             // largest distance of an instance's corner outside of a box above it
  double most_slack_m = 0;            // largest excess of a leaf's box

 private:
  // Record number `index` of an array that begins at float4 number `first`.
  template <class Record>
  Record at(size_t first, size_t index) const {
    Record record;
    std::memcpy(&record, &moving_.at(first + index * (sizeof(Record) / 16)), sizeof record);
    return record;
  }

  // Returns the span of the node's corners.
  Span visit(size_t node, size_t depth) {
    deepest = std::max(deepest, depth);
    const wt_centred_node n = at<wt_centred_node>(sizeof(wt_moving_head) / 16, node);
    Span all{glm::dvec3(1e30), glm::dvec3(-1e30)};
    for (size_t side = 0; side < 2; ++side) {
      const auto& xy = side == 0 ? n.left.s : n.right.s;
      const float* z = n.z.s + 2 * side;
      const glm::dvec3 centre(xy[0], xy[2], z[0]), half_size(xy[1], xy[3], z[1]);
      const int32_t child = n.child.s[side];
      const uint32_t leaf = static_cast<uint32_t>(child) ^ 0xFFFFFFFFu;
      if (child < 0 && (leaf & 15) == 0) {
        for (int axis = 0; axis < 3; ++axis) CHECK(half_size[axis] < 0);
        continue;
      }
      if (child < 0) CHECK((leaf & 15) == 1);
      const Span below = child < 0 ? corners(leaf >> WT_LEAF_BITS) : visit(static_cast<size_t>(child), depth + 1);
      const glm::dvec3 outside = glm::max(centre - half_size - below.lower, below.upper - (centre + half_size));
      for (int axis = 0; axis < 3; ++axis) worst_gap_m = std::max(worst_gap_m, outside[axis]);
      if (child < 0)
        for (int axis = 0; axis < 3; ++axis) most_slack_m = std::max(most_slack_m, -outside[axis]);
      else
        half_areas += half_size.x * half_size.y + half_size.y * half_size.z + half_size.z * half_size.x;
      all = {glm::min(all.lower, below.lower), glm::max(all.upper, below.upper)};
    }
    return all;
  }

  // Returns the corners of the box of an instance's model, turned and moved in double; checks the instance's record.
  Span corners(size_t leaf) {
    const auto record = at<wt_instance>(at<wt_moving_head>(0, 0).instances, leaf);
    const uint32_t number = record.number;
    CHECK(leaf == instances.size());  // leaves follow each other from left to right, as instances do in memory
    instances.insert(number);
    REQUIRE(number < traffic_.instances.size());
    const Instance& instance = traffic_.instances[number];
    const Placement& placement = traffic_.placements[number];
    for (int row = 0; row < 3; ++row) {
      for (int axis = 0; axis < 3; ++axis)
        CHECK(record.row[row].s[axis] == static_cast<float>(placement.rotation[row][axis]));
      CHECK(record.row[row].s[3] == static_cast<float>(placement.position_m[row]));
    }
    CHECK(record.first_surface == instance.first_surface);
    CHECK(record.first_primitive == instance.first_surface);  // a surface per triangle
    if (instance.model == 0) CHECK(record.root == 0);
    if (instance.model == 1) CHECK(record.root > 0);
    const Scene& model = traffic_.models[instance.model];
    Span out{glm::dvec3(1e30), glm::dvec3(-1e30)};
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p(corner & 1 ? model.upper.x : model.lower.x, corner & 2 ? model.upper.y : model.lower.y,
                         corner & 4 ? model.upper.z : model.lower.z);
      const glm::dvec3 moved = placement.position_m + placement.rotation * p;
      out = {glm::min(out.lower, moved), glm::max(out.upper, moved)};
    }
    return out;
  }

  const Traffic& traffic_;
  std::vector<wt_float4> moving_;
};

void check_tree(const Traffic& traffic, const DeviceScene& scene) {
  const Walk walk(traffic, scene);
  const std::multiset<uint32_t> present = traffic.present();
  CHECK(walk.instances == present);
  CHECK(walk.deepest <= std::max<size_t>(std::bit_width(present.size() - !present.empty()), 1));
  CHECK(walk.worst_gap_m <= 0);
  CHECK(walk.most_slack_m < 4e-4);  // padding of 2e-6 of the extent on both sides, and roundings
}

}  // namespace

TEST_CASE("the device's tree holds every instance that is present once, inside of its boxes") {
  for (const size_t count : {1, 2, 3, 4, 5, 17, 300}) {
    CAPTURE(count);
    const Traffic traffic = with_gaps(count, 9);
    check_tree(traffic, traffic.upload(TopLevelBuild::device));
  }
}

TEST_CASE("a tree over absent instances alone is a root that no ray enters") {
  Traffic traffic(3, 5);
  for (Placement& placement : traffic.placements) placement.present = false;
  check_tree(traffic, traffic.upload(TopLevelBuild::device));
  check_hits(traffic, 1000, 12);
}

TEST_CASE("rays hit the same through the device's tree as through the host's") {
  for (const size_t count : {1, 2, 3, 17, 300}) {
    CAPTURE(count);
    check_hits(with_gaps(count, 9), 2000, 12);
  }
}

TEST_CASE("instances move on: a tree is that of its frame alone") {
  Traffic traffic = with_gaps(40, 9);
  const Scene still = scene_of_triangles(traffic.still);
  auto [scene, place] = with_instances(context(), make_device_scene(context(), still, false, 60), still, traffic.models,
                                       traffic.instances);
  InstancePlacement instances(context(), std::move(place), traffic.instances.size(), TopLevelBuild::device);
  instances.place(scene, traffic.placements);
  Random random(3);
  for (Placement& placement : traffic.placements) {
    placement.position_m = random.in_cube(9);
    placement.present = random() < 0.5;
  }
  instances.place(scene, traffic.placements);
  check_tree(traffic, scene);
}

TEST_CASE("keys order instances by their places on the ground") {
  Traffic traffic(300, 11, 50);
  for (Placement& placement : traffic.placements) placement.position_m.z = 0;
  const Walk device(traffic, traffic.upload(TopLevelBuild::device)), host(traffic, traffic.upload());
  CHECK(device.half_areas < 1.25 * host.half_areas);  // unordered it is several times as much
}
