// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/fields/vegetation.cl.
// A work-item takes one path; the tree is over the boxes of volumes, which never move.
#include "passes/vegetation.hpp"

#include <algorithm>
#include <cmath>

#include "accel/instance_tree.hpp"
#include "passes/advice.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {
namespace {

// The box around a volume in float32, rounded outwards.
Box box_of(const device::wt_volume& volume) {
  const double across[2] = {
      std::abs(volume.cosine) * volume.half_size[0] + std::abs(volume.sine) * volume.half_size[1],
      std::abs(volume.sine) * volume.half_size[0] + std::abs(volume.cosine) * volume.half_size[1]};
  const double half[3] = {across[0], across[1], volume.half_size[2]};
  Box out;
  for (int axis = 0; axis < 3; ++axis) {
    out.lower[axis] = std::nextafter(static_cast<float>(volume.centre[axis] - half[axis]), -Box::kInfinity);
    out.upper[axis] = std::nextafter(static_cast<float>(volume.centre[axis] + half[axis]), Box::kInfinity);
  }
  return out;
}

// The same lists for volumes in another order, by their new numbers.
std::vector<uint32_t> earlier_in(const std::vector<uint32_t>& order, const std::vector<uint32_t>& moved,
                                 const std::vector<uint32_t>& earlier) {
  std::vector<uint32_t> out(1, static_cast<uint32_t>(order.size() + 1));
  for (const uint32_t volume : order) out.push_back(out.back() + earlier[volume + 1] - earlier[volume]);
  for (const uint32_t volume : order)
    for (uint32_t i = earlier[volume]; i < earlier[volume + 1]; ++i) out.push_back(moved[earlier[i]]);
  return out;
}

}  // namespace

Vegetation::Vegetation(gpu::Context& context, const VolumeTable& table)
    : context_(context),
      kernel_(context),
      work_(tuning_of(context.info()).exact),
      kinds_(static_cast<uint32_t>(table.material.size())),
      triangles_(context.buffer(table.triangles, "triangles of vegetation")) {
  std::vector<Box> boxes;
  for (const device::wt_volume& volume : table.volumes) boxes.push_back(box_of(volume));
  const TopLevel tree = build_top_level(boxes);
  std::vector<device::wt_volume> ordered;
  std::vector<uint32_t> moved(table.volumes.size());
  for (const uint32_t volume : tree.order) {
    moved[volume] = static_cast<uint32_t>(ordered.size());
    ordered.push_back(table.volumes[volume]);
  }
  earlier_ = context.buffer(earlier_in(tree.order, moved, table.earlier), "overlaps of vegetation");
  nodes_ = context.buffer(tree.nodes, "tree of vegetation");
  volumes_ = context.buffer(ordered, "vegetation");
}

const gpu::Buffer<double>& Vegetation::operator()(const RadioEnds& ends, const SolvedList& visible,
                                                  Counters& counters) {
  const size_t lengths = size_t{visible.count} * kinds_;
  if (lengths_.size() < lengths)
    lengths_ = context_.buffer<double>(lengths + lengths / 4, {"lengths in vegetation", advice::links});
  if (lengths > 0)
    kernel_(work_.range(visible.count), Stage::vegetation,
            calls::vegetation::vegetation{.nodes = nodes_,
                                          .volumes = volumes_,
                                          .triangles = triangles_,
                                          .earlier = earlier_,
                                          .transmitters = ends.transmitters,
                                          .receivers = ends.receivers,
                                          .visible = visible.headers,
                                          .vertices = visible.vertices,
                                          .counters = counters.buffer(),
                                          .lengths = lengths_,
                                          .args = wt_vegetation_arguments{.visible_count = visible.count,
                                                                          .visible_counter = visible.counter,
                                                                          .max_depth = visible.max_depth,
                                                                          .kinds = kinds_}});
  return lengths_;
}

}  // namespace wavetracer
