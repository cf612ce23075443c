// SPDX-License-Identifier: Apache-2.0
// A launch that grows where it still finds something: the loop over the levels of refine. Good and Turing (I. J. Good,
// Biometrika 40, 1953): the share of sequences met once estimates the share that was not met yet.
#pragma once
#include <optional>
#include <vector>

#include "passes/compact.hpp"
#include "passes/generate_rays.hpp"
#include "passes/refine.hpp"
#include "passes/scan.hpp"
#include "simulation/launch.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

class Refinement {
 public:
  // hilly: the ground has many surfaces, and rays have to find each of them.
  Refinement(gpu::Context& context, const TraceConfig& config, std::shared_ptr<const LaunchHeights> heights,
             bool hilly = false);
  // Makes the first level for these launchers. slots: those of the set of sequences. frame: the number since the last
  // cold one, which is 0. Frames that have the sequences of earlier ones launch fewer rays, in directions of their own.
  void start(const std::vector<Launcher>& launchers, uint64_t slots, uint64_t frame);
  // The samples to trace now.
  const SampleList& level() const { return lists_[current_]; }
  // Fills the queue with samples first .. first + count - 1 of the level.
  void generate(RayQueue& queue, uint32_t first, uint32_t count);
  // Prepares the next level, once all samples of this one have been traced. Returns false if the launch ends here;
  // end() has the reason.
  bool descend();
  LaunchEnd end() const { return end_; }
  // The share of all sequences met that a single sample met.
  double share_once() const { return share_once_; }

 private:
  void begin_level(uint64_t launcher_count, uint32_t level);
  bool ends(LaunchEnd reason);  // returns false, like descend()

  gpu::Context& context_;
  TraceConfig config_;
  std::shared_ptr<const LaunchHeights> heights_;
  uint32_t finer_;  // levels by which a launch begins further down
  GenerateRays generate_;
  Refine refine_;
  Compact compact_;
  Scan scan_;
  gpu::Buffer<float> launchers_, marks_;
  gpu::Buffer<uint32_t> hits_, blocks_, list_;
  SampleList lists_[3];           // the first level, kept for the next frame, and two that take turns
  uint64_t first_launchers_ = 0;  // launchers whose samples lists_[0] has, at its level
  size_t current_ = 0;
  DirectionTurn turn_;
  uint32_t rare_ = 0;
  uint64_t most_ = 0, launched_ = 0;  // numbers of rays of all launchers
  double share_once_ = 0;
  LaunchEnd end_ = LaunchEnd::recall;
};

}  // namespace wavetracer
