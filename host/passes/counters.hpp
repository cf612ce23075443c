// SPDX-License-Identifier: Apache-2.0
// counters: the counts of the kernels of a frame, and the lengths of the lists that they make. The host reads the
// length of a list where it cannot know it before. Where frames follow each other it foresees the length from the last
// frames, with room to spare. A pass is launched for that many elements, its kernel finds the true length on the device
// (kernels/lib/count.clh), and one look at the end of the frame tells whether all lists were as short as foreseen. So a
// frame waits for the device once.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

class Counters {
 public:
  using Count = wt_uint wt_counters::*;

  // Makes counters that are all zero.
  explicit Counters(gpu::Context& context);
  gpu::Buffer<wt_counters>& buffer() { return buffer_; }
  // Sets all to zero; nothing is foreseen of them yet.
  void zero();
  // Says that a kernel has set them to zero.
  void zeroed() {
    foreseen_.clear();
    in_parts_ = false;
  }
  // One of them begins again with this number.
  void restart(Count count, uint32_t from, Stage stage);
  // So many nodes are listed, and none after them.
  void restart_nodes(uint32_t count, Stage stage);
  // A list is made in parts, of which the counters have the last alone: nothing is foreseen from this frame.
  void in_parts() { in_parts_ = true; }
  // Rays of bounces are counted from zero again.
  void restart_ended(Stage stage);
  // As they are now; waits for the device.
  wt_counters read(Stage stage) const { return buffer_.read_one(0, stage); }

  // Sets whether lengths are foreseen from now on; the first frame must have settled before.
  void foresee(bool on) { foresees_ = on && known_; }
  bool foresees() const { return foresees_; }
  // The foreseen length of a list; its capacity does not limit it.
  uint64_t expected(Count count) const;
  // The length of the list that `count` counts, which has room for `capacity` elements: read, and then it may be more
  // than that, or foreseen.
  uint32_t length(Count count, size_t capacity, Stage stage);
  // The counts of the last frame.
  const wt_counters& last() const { return last_; }
  // The frame has ended with these counters: was all as foreseen? If so, the next frame foresees from them. If not, the
  // passes must run again and each length must be read.
  bool settle(const wt_counters& now);

 private:
  gpu::Context& context_;
  gpu::Buffer<wt_counters> buffer_;
  bool foresees_ = false, known_ = false, in_parts_ = false;
  wt_counters last_{}, most_{};                       // the last frame's; the most of recent frames
  std::vector<std::pair<Count, uint32_t>> foreseen_;  // lengths foreseen since zero()
};

// The number of a counter for kernels that take the length of a list by it: its word in wt_counters.
uint32_t counter_word(Counters::Count count);

}  // namespace wavetracer
