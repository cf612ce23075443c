// Host side of kernels/place.cl, and the top-level tree where the host builds it: faster than a device for some hundred
// vehicles (bench_drive). What instances are whatever the frame is uploaded once.
#include "passes/place.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "accel/layout.hpp"
#include "accel/top_level.hpp"
#include "wavetracer/device/bvh.h"
#include "wavetracer/device/moving.h"

namespace wavetracer {

namespace {

float bits(uint32_t word) { return std::bit_cast<float>(word); }

int32_t moved_child(int32_t child, uint32_t first_node, uint32_t first_leaf) {
  if (child >= 0) return child + static_cast<int32_t>(first_node);
  return ~static_cast<int32_t>(static_cast<uint32_t>(~child) + (first_leaf << WT_LEAF_BITS));
}

// Appends a tree's nodes of `floats` floats each, whose `children` references begin at float `at`.
void append_nodes(std::vector<float>& all, std::vector<float> nodes, size_t floats, size_t at, size_t children,
                  uint32_t first_leaf) {
  const auto first_node = static_cast<uint32_t>(all.size() / floats);
  for (size_t node = 0; node < nodes.size(); node += floats)
    for (size_t k = node + at; k < node + at + children; ++k)
      nodes[k] = std::bit_cast<float>(moved_child(std::bit_cast<int32_t>(nodes[k]), first_node, first_leaf));
  all.insert(all.end(), nodes.begin(), nodes.end());
}

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
             DeviceScene& scene)
    : kernel_(context.kernel("place", "place")),
      local_(context.info().simple_local_size()),
      instances_(instances),
      models_(models.size()),
      first_surface_(static_cast<uint32_t>(scene.surfaces.size())),
      extent_m_(scene.extent_m) {
  uint32_t primitive = scene.primitive_count;
  for (const Instance& instance : instances_) {
    first_primitive_.push_back(primitive);
    primitive += static_cast<uint32_t>(models[instance.model].triangles.size());
  }
  upload_surfaces(context, models, scene);
  upload_trees(context, models, scene);
  for (const Instance& instance : instances_) {
    wt_exact_instance& record = records_.emplace_back();
    record.first_surface = instance.first_surface;
    record.first_model_surface = models_[instance.model].first_surface;
  }
  scene.exact_instances = context.buffer<wt_exact_instance>(records_.size(), "instances");
  scene.definitions["WT_INSTANCES"] = "1";
}

void Place::upload_surfaces(gpu::Context& context, const std::vector<Scene>& models, DeviceScene& scene) {
  std::vector<wt_model_surface> records;
  std::vector<double> corners = scene.exact_triangles.read();
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
  scene.exact_triangles = context.buffer(corners, "surface triangles");
  const auto extended = [&](auto& buffer, const char* name) {
    auto records_of_all = buffer.read();
    records_of_all.resize(size_t{first_surface_} + surface_count_);
    buffer = context.buffer(records_of_all, name);
  };
  extended(scene.surfaces, "surfaces");
  extended(scene.exact_surfaces, "exact surfaces");
}

void Place::upload_trees(gpu::Context& context, const std::vector<Scene>& models, DeviceScene& scene) {
  std::vector<float> nodes, leaves;
  std::vector<Bvh2> trees;
  uint32_t stack = 0;
  for (size_t m = 0; m < models.size(); ++m) {
    const std::vector<AccelTriangle> triangles = accel_triangles(models[m]);
    models_[m].box = box_of(triangles);
    if (scene.cpu) {
      models_[m].root = static_cast<uint32_t>(nodes.size() / WT_BVH8_NODE_FLOATS);
      const Bvh8 eight = make_bvh8(build_binary(triangles, BuildOptions::for_bvh8()), triangles);
      const auto first_block = static_cast<uint32_t>(leaves.size() / WT_BLOCK_FLOATS);
      append_nodes(nodes, eight.nodes, WT_BVH8_NODE_FLOATS, 48, 8, first_block);
      leaves.insert(leaves.end(), eight.blocks.begin(), eight.blocks.end());
      stack = std::max(stack, 7 * eight.max_depth + 1);
    } else {
      models_[m].root = static_cast<uint32_t>(nodes.size() / WT_BVH2_NODE_FLOATS);
      trees.push_back(make_bvh2(build_binary(triangles, BuildOptions::for_bvh2()), triangles));
      // Rays in model coordinates start as far away as the scene is wide.
      const std::vector<float> centred = centred_boxes(trees.back().nodes, 4 * extent_m_);
      append_nodes(nodes, centred, WT_BVH2_NODE_FLOATS, 12, 2, triangle_slots_);
      triangle_slots_ += trees.back().triangle_slots;
      stack = std::max(stack, trees.back().max_depth);
    }
  }
  for (size_t copy = 0; copy < 3; ++copy)
    for (const Bvh2& tree : trees) {
      const size_t floats = tree.triangles.size() / 3;
      leaves.insert(leaves.end(), tree.triangles.begin() + static_cast<std::ptrdiff_t>(copy * floats),
                    tree.triangles.begin() + static_cast<std::ptrdiff_t>((copy + 1) * floats));
    }
  scene.require_stack(scene.cpu ? "WT_BVH8_STACK" : "WT_BVH2_STACK", stack);

  // The parts begin at even float4: vectors of eight are read from there.
  instances_at_ = WT_MOVING_TOP + 4 * std::max<size_t>(instances_.size(), 2);
  nodes_at_ = instances_at_ + WT_INSTANCE_FLOAT4S * instances_.size();
  triangles_at_ = nodes_at_ + nodes.size() / 4;
  const float head[4] = {bits(static_cast<uint32_t>(instances_at_)), bits(static_cast<uint32_t>(nodes_at_)),
                         bits(static_cast<uint32_t>(triangles_at_)), bits(triangle_slots_)};
  scene.moving = context.buffer<float>(4 * triangles_at_ + leaves.size(), "moving");
  scene.moving.write(head);
  scene.moving.write(nodes, 4 * nodes_at_);
  scene.moving.write(leaves, 4 * triangles_at_);
  top_.resize(4 * (nodes_at_ - WT_MOVING_TOP));
}

std::vector<float> Place::bodies() const {
  std::vector<float> bodies;
  bodies.reserve(8 * instances_.size());
  for (size_t i = 0; i < instances_.size(); ++i) {
    const Model& model = models_[instances_[i].model];
    const auto &lower = model.box.lower, &upper = model.box.upper;
    bodies.insert(bodies.end(), {lower[0], lower[1], lower[2], bits(model.root)});
    bodies.insert(bodies.end(), {upper[0], upper[1], upper[2], bits(first_primitive_[i])});
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
    }
    record.present = placements[i].present;
  }
  scene.exact_instances.write(records_, 0, "place");
  kernel_({surface_count_, local_}, "place", scene.exact_instances, model_surfaces_, surface_instances_, first_surface_,
          surface_count_, scene.exact_surfaces, scene.surfaces);
}

void Place::write_top_level(DeviceScene& scene, std::span<const Placement> placements) {
  present_.clear();
  boxes_.clear();
  for (uint32_t i = 0; i < instances_.size(); ++i) {
    if (!placements[i].present) continue;
    present_.push_back(i);
    boxes_.push_back(placed(models_[instances_[i].model].box, placements[i]));
  }
  TopLevel tree = build_top_level(boxes_);
  const std::vector<float> nodes = centred_boxes(std::move(tree.nodes), extent_m_);
  std::ranges::copy(nodes, top_.begin());
  float* record = &top_[4 * (instances_at_ - WT_MOVING_TOP)];
  for (const uint32_t leaf : tree.order) {
    write_instance(record, present_[leaf], placements[present_[leaf]]);
    record += 4 * WT_INSTANCE_FLOAT4S;
  }
  scene.moving.write(top_, 4 * WT_MOVING_TOP, "place");
}

void Place::write_instance(float* record, uint32_t i, const Placement& placement) const {
  for (int k = 0; k < 3; ++k, record += 4) {  // row k of the inverse rotation is column k of the rotation
    for (int axis = 0; axis < 3; ++axis) record[axis] = static_cast<float>(placement.rotation[k][axis]);
    record[3] = static_cast<float>(placement.position_m[k]);
  }
  record[0] = bits(models_[instances_[i].model].root);
  record[1] = bits(instances_[i].first_surface);
  record[2] = bits(first_primitive_[i]);
  record[3] = bits(i);
}

}  // namespace wavetracer
