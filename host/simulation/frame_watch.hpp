// SPDX-License-Identifier: Apache-2.0
// The observer of a frame, which may cancel it: see Simulation::observe().
// Long passes report their progress between launches; nothing here waits for the device.
#pragma once
#include <algorithm>
#include <array>
#include <utility>

#include "wavetracer/simulation.hpp"

namespace wavetracer {

class FrameWatch {
 public:
  void set(FrameObserver observer) { observer_ = std::move(observer); }
  // Says that part `part` of `parts` of a frame follows, counted from 0; all parts count as equally large.
  void set_part(uint64_t part, uint64_t parts) {
    part_ = part;
    parts_ = parts;
    if (part == 0) largest_ = {};
  }
  // Throws FrameStopped if the observer has cancelled the frame.
  void tell(decltype(FrameProgress::stage) stage, uint64_t done, uint64_t total) const {
    uint64_t& largest = largest_[stage.index()];
    largest = parts_ > 1 ? std::max(largest, total) : total;
    if (observer_ && !observer_({stage, part_ * largest + done, parts_ * largest, part_, parts_})) throw FrameStopped();
  }

 private:
  FrameObserver observer_;
  uint64_t part_ = 0, parts_ = 1;
  mutable std::array<uint64_t, 2> largest_{};  // numbers of launches and steps of a part, by stage
};

}  // namespace wavetracer
