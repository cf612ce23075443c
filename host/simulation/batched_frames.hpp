// SPDX-License-Identifier: Apache-2.0
// Runs frames, in batches of receivers where those are too many for the device at once (receiver_batches.hpp). Batches
// whose lists are too long for the device are halved.
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "simulation/frame.hpp"
#include "wavetracer/frame_result.hpp"

namespace wavetracer {

class BatchedFrames {
 public:
  // Makes the task of a frame, for links that may be a part of its links.
  using TaskOf = std::function<FrameTask(const LinkPart& links)>;

  // setup outlives this.
  explicit BatchedFrames(Setup& setup) : setup_(setup), loop_(setup) {}

  // Runs a frame, or the part of it with these links. It is cut into batches only if frames reuse nothing.
  FrameResult run(const TaskOf& task, const LinkPart& links);
  // As FrameLoop::sum_links().
  void sum_links(bool on) {
    summed_ = on;
    loop_.sum_links(on);
  }
  // For frames that are never cut, and to forget earlier ones.
  FrameLoop& loop() { return loop_; }

 private:
  void halve(std::deque<ReceiverRange>& left);
  // Says that batches were halved, and what that costs.
  std::string halved_warning() const;
  FrameResult run_batches(const TaskOf& task, const LinkPart& links, std::deque<ReceiverRange> left);

  Setup& setup_;
  FrameLoop loop_;
  bool summed_ = false;
  uint32_t fitting_ = no_end;  // the most receivers of a batch whose lists the device can hold, as far as is known
};

}  // namespace wavetracer
