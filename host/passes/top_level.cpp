// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/vehicles/top_level.cl.
// It makes four launches beside those of the sort, for any number of instances.
#include "passes/top_level.hpp"

#include <algorithm>
#include <string>

#include "passes/tuning.hpp"

namespace wavetracer {

TopLevelTree::TopLevelTree(gpu::Context& context, const std::vector<wt_body>& bodies)
    : local_(context.info().simple_local_size()),
      group_(tuning_of(context.info()).top_level_items),
      bodies_(context.buffer(bodies, "bodies of instances")) {
  instances_.count = static_cast<uint32_t>(bodies.size());
  instances_.keys = context.buffer<uint32_t>(instances_.count, "keys of instances");
  instances_.order = context.buffer<uint32_t>(instances_.count, "order of instances");
  boxes_ = context.buffer<float>(8 * size_t{instances_.count}, "boxes of instances");
  tree_ = context.buffer<float>(8 * (2 * std::max<size_t>(instances_.count, 2) - 1), "boxes of the top-level tree");
  const gpu::Definitions definitions = {{"WT_KEY_LEVEL", std::to_string(InstanceOrder::key_level)},
                                        {"WT_ITEMS", std::to_string(group_)}};
  instance_keys_ = {context, definitions};
  leaves_ = {context, definitions};
  inner_boxes_ = {context, definitions};
  top_nodes_ = {context, definitions};
}

InstanceOrder& TopLevelTree::keys(const DeviceScene& scene) {
  instance_keys_({instances_.count, local_}, Stage::place,
                 calls::top_level::instance_keys{.instances = scene.exact_instances,
                                                 .bodies = bodies_,
                                                 .instance_count = instances_.count,
                                                 .extent_m = scene.extent_m,
                                                 .boxes = boxes_,
                                                 .keys = instances_.keys});
  return instances_;
}

void TopLevelTree::operator()(DeviceScene& scene, uint32_t present) {
  const uint32_t leaf_count = std::max(present, 2u);
  leaves_({leaf_count, local_}, Stage::place,
          calls::top_level::leaves{.order = instances_.order,
                                   .instances = scene.exact_instances,
                                   .bodies = bodies_,
                                   .boxes = boxes_,
                                   .present = present,
                                   .leaf_count = leaf_count,
                                   .tree = tree_,
                                   .moving = scene.moving});
  inner_boxes_({group_, group_}, Stage::place, calls::top_level::inner_boxes{.leaf_count = leaf_count, .tree = tree_});
  top_nodes_({leaf_count - 1, local_}, Stage::place,
             calls::top_level::top_nodes{.tree = tree_,
                                         .present = present,
                                         .leaf_count = leaf_count,
                                         .extent_m = scene.extent_m,
                                         .moving = scene.moving});
}

}  // namespace wavetracer
