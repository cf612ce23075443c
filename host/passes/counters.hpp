// counters: what the kernels of a frame count, and how long the lists are that they make.
// The host reads the length of a list where nothing tells it before. Where frames follow each other it is foreseen,
// from the last frame and with room to spare: a pass is launched for that many, its kernel finds the true length on the
// device (kernels/lib/count.clh), and one look at the end of the frame says whether all lists were as short as
// foreseen. So a frame waits for the device once.
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

  // All are zero.
  explicit Counters(gpu::Context& context);
  gpu::Buffer<wt_counters>& buffer() { return buffer_; }
  // All begin with zero, and nothing is foreseen of them yet.
  void zero();
  // A kernel has made them so.
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

  // Are lengths foreseen from now on? Not before a frame has settled.
  void foresee(bool on) { foresees_ = on && known_; }
  bool foresees() const { return foresees_; }
  // What is foreseen of a list, whatever it has room for.
  uint64_t expected(Count count) const;
  // The length of the list that `count` counts, which has room for `capacity` elements: read, and then it may be more
  // than that, or foreseen.
  uint32_t length(Count count, size_t capacity, Stage stage);
  // What the last frame counted.
  const wt_counters& last() const { return last_; }
  // The frame has ended with these counters: was all as foreseen? If so they are what the next frame foresees from. If
  // not, the passes must run again and each length be read.
  bool settle(const wt_counters& now);

 private:
  gpu::Context& context_;
  gpu::Buffer<wt_counters> buffer_;
  bool foresees_ = false, known_ = false, in_parts_ = false;
  wt_counters last_{}, most_{};                       // of the last frame; the most of late
  std::vector<std::pair<Count, uint32_t>> foreseen_;  // since zero()
};

// The number of a counter for kernels that take the length of a list by it: its word in wt_counters.
uint32_t counter_word(Counters::Count count);

}  // namespace wavetracer
