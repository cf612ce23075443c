// A launch that grows where it still finds something: the loop over the levels of refine.
// Good and Turing (I. J. Good, Biometrika 40, 1953): the share of sequences met once tells what is still to be met.
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
  // hilly: the ground is many surfaces, each of which rays have to find.
  Refinement(gpu::Context& context, const TraceConfig& config, std::shared_ptr<const LaunchHeights> heights,
             bool hilly = false);
  // The first level for these launchers; slots: of the set of sequences. frame: since the last cold one, which is 0.
  // Frames that have the sequences of earlier ones launch fewer rays, and in directions of their own.
  void start(const std::vector<Launcher>& launchers, uint64_t slots, uint64_t frame);
  // The samples to trace now.
  const SampleList& level() const { return lists_[current_]; }
  // The queue becomes samples first .. first + count - 1 of the level.
  void generate(RayQueue& queue, uint32_t first, uint32_t count);
  // All samples of the level have been traced: prepares the next. False when the launch ends here, for the reason of
  // end().
  bool descend();
  LaunchEnd end() const { return end_; }
  // Of all sequences met, the share that one sample alone met.
  double share_once() const { return share_once_; }

 private:
  void begin_level(uint64_t launcher_count, uint32_t level);
  bool ends(LaunchEnd reason);  // false, as descend() returns

  gpu::Context& context_;
  TraceConfig config_;
  std::shared_ptr<const LaunchHeights> heights_;
  uint32_t finer_;  // levels that a launch begins further down
  GenerateRays generate_;
  Refine refine_;
  Compact compact_;
  Scan scan_;
  gpu::Buffer<float> launchers_, marks_;
  gpu::Buffer<uint32_t> hits_, blocks_, list_;
  SampleList lists_[3];           // the first level, kept for the next frame, and two that take turns
  uint64_t first_launchers_ = 0;  // that lists_[0] has the samples of, at its level
  size_t current_ = 0;
  DirectionTurn turn_;
  uint32_t rare_ = 0;
  uint64_t most_ = 0, launched_ = 0;  // rays of all launchers
  double share_once_ = 0;
  LaunchEnd end_ = LaunchEnd::recall;
};

}  // namespace wavetracer
