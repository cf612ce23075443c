// SPDX-License-Identifier: Apache-2.0
// The source of rays: it gives the directions of a launch in the order of the configuration, and labels rays if a later
// pass needs to know their transmitters.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "passes/label_rays.hpp"
#include "simulation/launch.hpp"
#include "simulation/ray_follower.hpp"
#include "simulation/ray_order.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

class RaySource {
 public:
  // extent_m: the largest absolute coordinate of scene and rays. labels: queues have WT_RAY_LABELLED_PLANES.
  RaySource(gpu::Context& context, const TraceConfig& trace, const OrderPlan& plan, bool labels, float extent_m);
  // Makes room for queues of this many rays.
  void reserve(uint64_t rays);
  // Sets the tables for directions = "horizon" that launchers name from now on, see LaunchHeights.
  void set_heights(const std::vector<float>& tables) { heights_->set(tables); }
  const std::shared_ptr<LaunchHeights>& heights() const { return heights_; }
  // Appends the rays first .. first + count - 1 of the launch, counted over all its launchers. Returns their parts by
  // launcher.
  std::vector<LaunchPart> launch(RayQueue& rays, const Launch& launch, uint64_t first, uint64_t count);
  // Are rays neither sorted nor labelled?
  bool as_launched() const { return !order_ && !label_; }
  // Labels the rays of a queue that know their samples (a refined launch).
  void label(RayQueue& rays);
  // Sorts the queue before the segments of this depth, if the configuration asks for it. spare has the same capacity
  // and is overwritten.
  void sort(RayQueue& rays, RayQueue& spare, uint32_t depth);

 private:
  GenerateRays& generator(uint64_t rays);

  gpu::Context& context_;
  TraceConfig trace_;
  bool sort_each_depth_;
  std::shared_ptr<LaunchHeights> heights_;
  std::map<uint64_t, GenerateRays> generators_;  // by the number of directions; made when they are first needed
  std::optional<LabelRays> label_;
  std::optional<RayOrder> order_;  // set if the plan has one
};

}  // namespace wavetracer
