// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/vehicles/place.cl, and the top-level tree where the host builds it, which is faster than a
// device up to some hundred vehicles (bench_drive). Data of instances that does not depend on the frame is uploaded
// once.
#include "passes/place.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "accel/instance_tree.hpp"
#include "accel/layout.hpp"
#include "passes/advice.hpp"

namespace wavetracer {

namespace {

int32_t moved_child(int32_t child, uint32_t first_node, uint32_t first_leaf) {
  if (child >= 0) return child + static_cast<int32_t>(first_node);
  const uint32_t first = wt_leaf_first(child);
  return wt_leaf(first + first_leaf, wt_leaf_end(child) - first);
}

// The children of a node, used or not.
std::span<int32_t> children(wt_centred_node& node) { return std::span(node.child.s).first(2); }
std::span<int32_t> children(wt_bvh8_node& node) { return node.child; }

// Appends a tree and shifts its references, so that they count from the first node and leaf of all trees.
template <class Node>
void append_nodes(std::vector<Node>& all, std::vector<Node> nodes, size_t first_leaf) {
  const auto first_node = static_cast<uint32_t>(all.size());
  for (Node& node : nodes)
    for (int32_t& child : children(node)) child = moved_child(child, first_node, static_cast<uint32_t>(first_leaf));
  all.insert(all.end(), nodes.begin(), nodes.end());
}

template <class T>
size_t float4s(const std::vector<T>& records) {
  static_assert(sizeof(T) % sizeof(wt_float4) == 0);
  return records.size() * (sizeof(T) / sizeof(wt_float4));
}

// Copies the records into float4s, which `moving` consists of.
template <class T>
std::vector<wt_float4> as_float4s(const std::vector<T>& records) {
  std::vector<wt_float4> out(float4s(records));
  if (!records.empty()) std::memcpy(out.data(), records.data(), out.size() * sizeof(wt_float4));
  return out;
}

constexpr size_t top_at = sizeof(wt_moving_head) / sizeof(wt_float4);  // the top-level tree follows the head

Box box_of(const std::vector<AccelTriangle>& triangles) {
  Box box;
  for (const AccelTriangle& triangle : triangles)
    for (const auto& vertex : triangle.v) box.grow(vertex);
  return box;
}

// The box of a turned and moved box, rounded outwards.
Box placed(const Box& box, const Placement& placement) {
  Box out;
  for (int axis = 0; axis < 3; ++axis) {
    double centre = placement.position_m[axis], half_size = 0;
    for (int k = 0; k < 3; ++k) {
      const double lower = static_cast<double>(box.lower[k]), upper = static_cast<double>(box.upper[k]);
      centre += placement.rotation[k][axis] * 0.5 * (lower + upper);
      half_size += std::abs(placement.rotation[k][axis]) * 0.5 * (upper - lower);
    }
    constexpr float infinity = std::numeric_limits<float>::infinity();
    out.lower[axis] = std::nextafter(static_cast<float>(centre - half_size), -infinity);
    out.upper[axis] = std::nextafter(static_cast<float>(centre + half_size), infinity);
  }
  return out;
}

}  // namespace

Place::Place(gpu::Context& context, const std::vector<Scene>& models, const std::vector<Instance>& instances,
             const DeviceScene& scene, size_t static_surfaces)
    : kernel_(context),
      local_(context.info().simple_local_size()),
      instances_(instances),
      models_(models.size()),
      first_surface_(static_cast<uint32_t>(static_surfaces)),
      extent_m_(scene.extent_m) {
  uint32_t primitive = scene.primitive_count;
  for (const Instance& instance : instances_) {
    first_primitive_.push_back(primitive);
    primitive += static_cast<uint32_t>(models[instance.model].triangles.size());
  }
}

PlacedScene Place::make(gpu::Context& context, DeviceScene scene, const Scene& still, const std::vector<Scene>& models,
                        const std::vector<Instance>& instances, const std::vector<bool>& opaque) {
  Place place(context, models, instances, scene, still.surfaces.size());
  place.upload_surfaces(context, still, models, opaque, scene);
  place.upload_trees(context, models, scene);
  for (const Instance& instance : instances) {
    wt_exact_instance& record = place.records_.emplace_back();
    record.first_surface = instance.first_surface;
    record.first_model_surface = place.models_[instance.model].first_surface;
    record.first_wedge = instance.first_wedge;
  }
  scene.exact_instances = context.buffer<wt_exact_instance>(place.records_.size(), "instances");
  scene.definitions["WT_INSTANCES"] = "1";
  return {std::move(scene), std::move(place)};
}

void Place::upload_surfaces(gpu::Context& context, const Scene& still, const std::vector<Scene>& models,
                            const std::vector<bool>& opaque, DeviceScene& scene) {
  std::vector<wt_model_surface> records;
  std::vector<double> corners = surface_corners(still);
  for (size_t m = 0; m < models.size(); ++m) {
    models_[m].first_surface = static_cast<uint32_t>(records.size());
    const auto first_triangle = static_cast<uint32_t>(corners.size() / 9);
    for (const Surface& s : models[m].surfaces) {
      wt_model_surface record{};
      for (int axis = 0; axis < 3; ++axis) {
        record.normal[axis] = s.normal[axis];
        record.lower[axis] = s.lower[axis];
        record.upper[axis] = s.upper[axis];
      }
      record.offset = s.offset_m;
      record.first_triangle = first_triangle + s.first_triangle;
      record.triangle_count = s.triangle_count;
      records.push_back(record);
    }
    const std::vector<double> more = surface_corners(models[m]);
    corners.insert(corners.end(), more.begin(), more.end());
  }
  std::vector<uint32_t> owners;
  for (uint32_t i = 0; i < instances_.size(); ++i)
    owners.insert(owners.end(), models[instances_[i].model].surfaces.size(), i);
  surface_count_ = static_cast<uint32_t>(owners.size());
  model_surfaces_ = context.buffer(records, "model surfaces");
  surface_instances_ = context.buffer(owners, "surface instances");
  scene.exact_triangles = context.buffer(corners, {"surface triangles", advice::scene});
  const SurfaceRecords all = device_surfaces(still, surface_count_, opaque);
  scene.surfaces = context.buffer(all.surfaces, "surfaces");
  scene.exact_surfaces = context.buffer(all.exact, "exact surfaces");
}

template <class Node, class Leaf>
void Place::upload(gpu::Context& context, DeviceScene& scene, const std::vector<Node>& nodes,
                   const std::vector<Leaf>& leaves) {
  // Trees over this many instances have fewer nodes; with one instance or none the tree has one node.
  const size_t top_nodes = std::max<size_t>(instances_.size(), 2);
  top_.resize(top_nodes * (sizeof(wt_centred_node) / sizeof(wt_float4)) +
              instances_.size() * (sizeof(wt_instance) / sizeof(wt_float4)));
  wt_moving_head head{};
  head.instances =
      static_cast<uint32_t>(top_at + top_.size() - instances_.size() * (sizeof(wt_instance) / sizeof(wt_float4)));
  head.nodes = static_cast<uint32_t>(top_at + top_.size());
  head.triangles = static_cast<uint32_t>(head.nodes + float4s(nodes));
  head.triangle_slots = triangle_slots_;
  instances_at_ = head.instances - top_at;
  scene.moving = context.buffer<wt_float4>(head.triangles + float4s(leaves), {"moving", advice::scene});
  scene.moving.write(as_float4s(std::vector{head}));
  scene.moving.write(as_float4s(nodes), head.nodes);
  scene.moving.write(as_float4s(leaves), head.triangles);
}

void Place::upload_trees(gpu::Context& context, const std::vector<Scene>& models, DeviceScene& scene) {
  if (scene.cpu)
    upload_bvh8(context, models, scene);
  else
    upload_bvh2(context, models, scene);
}

void Place::upload_bvh8(gpu::Context& context, const std::vector<Scene>& models, DeviceScene& scene) {
  std::vector<wt_bvh8_node> nodes;
  std::vector<wt_triangle_block> blocks;
  for (size_t m = 0; m < models.size(); ++m) {
    const std::vector<AccelTriangle> triangles = accel_triangles(models[m]);
    const Bvh8 tree = make_bvh8(build_binary(triangles, BuildOptions::for_bvh8()), triangles);
    models_[m].box = box_of(triangles);
    models_[m].root = static_cast<int32_t>(nodes.size());
    append_nodes(nodes, tree.nodes, blocks.size());
    blocks.insert(blocks.end(), tree.blocks.begin(), tree.blocks.end());
    scene.require_stack("WT_BVH8_STACK", 7 * tree.max_depth + 1);
  }
  upload(context, scene, nodes, blocks);
}

void Place::upload_bvh2(gpu::Context& context, const std::vector<Scene>& models, DeviceScene& scene) {
  std::vector<wt_centred_node> nodes;
  std::vector<Bvh2> trees;
  for (size_t m = 0; m < models.size(); ++m) {
    const std::vector<AccelTriangle> triangles = accel_triangles(models[m]);
    const Bvh2& tree = trees.emplace_back(make_bvh2(build_binary(triangles, BuildOptions::for_bvh2()), triangles));
    models_[m].box = box_of(triangles);
    models_[m].root = static_cast<int32_t>(nodes.size());
    // Rays in model coordinates may start as far away as the scene is wide.
    append_nodes(nodes, centred_nodes(tree.nodes, 4 * extent_m_), triangle_slots_);
    triangle_slots_ += tree.triangle_slots;
    scene.require_stack("WT_BVH2_STACK", tree.max_depth);
  }
  std::vector<wt_bvh2_triangle> leaves;  // all first copies, all second ones, all third ones
  for (size_t copy = 0; copy < 3; ++copy)
    for (const Bvh2& tree : trees) {
      const auto first = tree.triangles.begin() + static_cast<std::ptrdiff_t>(copy * tree.triangle_slots);
      leaves.insert(leaves.end(), first, first + tree.triangle_slots);
    }
  upload(context, scene, nodes, leaves);
}

std::vector<wt_body> Place::bodies() const {
  std::vector<wt_body> bodies;
  for (size_t i = 0; i < instances_.size(); ++i) {
    const Model& model = models_[instances_[i].model];
    wt_body& body = bodies.emplace_back();
    std::ranges::copy(model.box.lower, body.lower);
    std::ranges::copy(model.box.upper, body.upper);
    body.root = model.root;
    body.first_primitive = first_primitive_[i];
  }
  return bodies;
}

void Place::operator()(DeviceScene& scene, std::span<const Placement> placements) {
  surfaces(scene, placements);
  write_top_level(scene, placements);
}

void Place::surfaces(DeviceScene& scene, std::span<const Placement> placements) {
  for (size_t i = 0; i < records_.size(); ++i) {
    wt_exact_instance& record = records_[i];
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column)
        record.rotation[3 * row + column] = placements[i].rotation[column][row];
      record.position[row] = placements[i].position_m[row];
      record.velocity[row] = placements[i].velocity_m_s[row];
      record.angular_velocity[row] = placements[i].angular_velocity_rad_s[row];
    }
    record.present = placements[i].present;
  }
  scene.exact_instances.write(records_, 0, Stage::place);
  kernel_({surface_count_, local_}, Stage::place,
          calls::place::place{.instances = scene.exact_instances,
                              .models = model_surfaces_,
                              .surface_instances = surface_instances_,
                              .first_surface = first_surface_,
                              .surface_count = surface_count_,
                              .exact = scene.exact_surfaces,
                              .surfaces = scene.surfaces});
}

void Place::write_top_level(DeviceScene& scene, std::span<const Placement> placements) {
  present_.clear();
  boxes_.clear();
  for (uint32_t i = 0; i < instances_.size(); ++i) {
    if (!placements[i].present) continue;
    present_.push_back(i);
    boxes_.push_back(placed(models_[instances_[i].model].box, placements[i]));
  }
  const TopLevel tree = build_top_level(boxes_);
  std::ranges::copy(as_float4s(centred_nodes(tree.nodes, extent_m_)), top_.begin());
  std::vector<wt_instance> records;
  for (const uint32_t leaf : tree.order) records.push_back(instance_record(present_[leaf], placements[present_[leaf]]));
  std::ranges::copy(as_float4s(records), top_.begin() + static_cast<std::ptrdiff_t>(instances_at_));
  scene.moving.write(top_, top_at, Stage::place);
}

wt_instance Place::instance_record(uint32_t i, const Placement& placement) const {
  wt_instance record{};
  for (int k = 0; k < 3; ++k) {  // row k of the inverse rotation is column k of the rotation
    for (int axis = 0; axis < 3; ++axis) record.row[k].s[axis] = static_cast<float>(placement.rotation[k][axis]);
    record.row[k].s[3] = static_cast<float>(placement.position_m[k]);
  }
  record.root = models_[instances_[i].model].root;
  record.first_surface = instances_[i].first_surface;
  record.first_primitive = first_primitive_[i];
  record.number = i;
  return record;
}

}  // namespace wavetracer
