// SPDX-License-Identifier: Apache-2.0
// counters: the counts of the kernels of a frame, and the lengths of the lists that they make. The host reads the
// length of a list where it cannot know it before. Where frames follow each other it foresees the length from the last
// frames, with room to spare. A pass is launched for that many elements, its kernel finds the true length on the device
// (kernels/lib/count.clh), and one look at the end of the frame tells whether all lists were as short as foreseen. So a
// frame waits for the device once.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

class Counters {
 public:
  using Count = wt_uint wt_counters::*;

  // Says that all counters have just been set to zero: only what does so makes one, and none can be kept as a copy.
  class Zeroed {
    friend class Counters;
    friend class Sequences;  // its clear() is a kernel that does so
    Zeroed() {}
    Zeroed(const Zeroed&) = delete;
    Zeroed& operator=(const Zeroed&) = delete;
  };

  // Makes counters that are all zero.
  explicit Counters(gpu::Context& context);
  gpu::Buffer<wt_counters>& buffer() { return buffer_; }
  // Sets all to zero.
  Zeroed zero();
  // Runs the passes of a frame, from counters that zero() sets to zero, and returns the counters at their end, which
  // `stage` reads. alike: the frame does the same as the one before; then lengths are foreseen, if the frame before has
  // shown them, and zero() and passes() run once more, with every length read, if one proves longer than foreseen.
  // seen(counters): is called after each run. Throws std::logic_error within another run.
  template <class Zero, class Passes, class Seen>
  wt_counters settled(bool alike, Stage stage, const Zero& zero, const Passes& passes, const Seen& seen);
  // One of them begins again with this number.
  void restart(Count count, uint32_t from, Stage stage);
  // So many nodes are listed, and none after them.
  void restart_nodes(uint32_t count, Stage stage);
  // A list is made in parts, of which the counters have the last alone: nothing is foreseen from this frame on.
  void in_parts() { in_parts_ = true; }
  // Rays of bounces are counted from zero again.
  void restart_ended(Stage stage);
  // As they are now; waits for the device.
  wt_counters read(Stage stage) const { return buffer_.read_one(0, stage); }

  // Are lengths foreseen in this run?
  bool foresees() const { return foresees_; }
  // The foreseen length of a list; its capacity does not limit it.
  uint64_t expected(Count count) const;
  // The length of the list that `count` counts, which has room for `capacity` elements: read, and then it may be more
  // than that, or foreseen.
  uint32_t length(Count count, size_t capacity, Stage stage);
  // The counts of the last frame that was settled.
  const wt_counters& last() const { return last_; }

 private:
  // A run of passes: what it was told to foresee ends with it, also by an exception.
  struct Run {
    explicit Run(Counters& counters) : of(counters) {
      if (std::exchange(of.running_, true)) throw std::logic_error("counters: a frame runs within another");
    }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    ~Run() { of.running_ = of.foresees_ = false; }
    Counters& of;
  };

  void begin();  // nothing is foreseen yet
  // Was all as foreseen? If so, the next frame foresees from these counters.
  bool settles(const wt_counters& now);

  gpu::Context& context_;
  gpu::Buffer<wt_counters> buffer_;
  bool running_ = false, foresees_ = false, known_ = false, in_parts_ = false;
  wt_counters last_{}, most_{};                       // the last frame's; the most of recent frames
  std::vector<std::pair<Count, uint32_t>> foreseen_;  // lengths foreseen in this run
};

template <class Zero, class Passes, class Seen>
wt_counters Counters::settled(bool alike, Stage stage, const Zero& zero, const Passes& passes, const Seen& seen) {
  const Run run(*this);
  for (foresees_ = alike && known_;; foresees_ = false) {
    begin();
    [[maybe_unused]] const Zeroed from = zero();
    passes();
    const wt_counters now = read(stage);
    seen(now);
    if (!alike || settles(now)) return now;
  }
}

// The number of a counter for kernels that take the length of a list by it: its word in wt_counters.
uint32_t counter_word(Counters::Count count);

}  // namespace wavetracer
