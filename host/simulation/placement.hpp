// SPDX-License-Identifier: Apache-2.0
// Instances at their places in a frame: their surfaces and the tree over them, which the host builds if they are few
// and a GPU if they are many. Hits do not depend on which of them built it.
#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "passes/place.hpp"
#include "passes/sort.hpp"
#include "passes/top_level.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

// The builder of the top-level tree; fastest: the device and the number of instances present decide.
enum class TopLevelBuild { fastest, host, device };

class InstancePlacement {
 public:
  // place: see with_instances(); it moves `instances` of them.
  InstancePlacement(gpu::Context& context, Place place, size_t instances, TopLevelBuild build = TopLevelBuild::fastest)
      : place_(std::move(place)) {
    if (build == TopLevelBuild::host || (build == TopLevelBuild::fastest && tuning_of(context.info()).alone)) return;
    least_ = build == TopLevelBuild::device ? 0 : device_tree_instances;
    if (instances < least_) return;
    tree_.emplace(context, place_.bodies());
    sort_.emplace(context);
  }

  // Moves all instances, which are in the order of the placements, and builds the tree over them.
  void place(DeviceScene& scene, std::span<const Placement> placements) {
    const auto present = static_cast<uint32_t>(std::ranges::count(placements, true, &Placement::present));
    if (!tree_ || present < least_) {
      place_(scene, placements);
      return;
    }
    place_.surfaces(scene, placements);
    InstanceOrder& instances = tree_->keys(scene);
    (*sort_)(instances.keys, instances.order, instances.count, InstanceOrder::key_bits);
    (*tree_)(scene, present);
  }

 private:
  Place place_;
  std::optional<TopLevelTree> tree_;
  std::optional<Sort> sort_;
  size_t least_ = 0;
};

}  // namespace wavetracer
