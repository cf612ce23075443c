// The observer of a frame, which may cancel it: see Simulation::observe().
// Long passes report their progress between launches; nothing here waits for the device.
#pragma once
#include <utility>

#include "wavetracer/simulation.hpp"

namespace wavetracer {

class FrameWatch {
 public:
  void set(FrameObserver observer) { observer_ = std::move(observer); }
  // Throws FrameStopped if the observer has cancelled the frame.
  void tell(decltype(FrameProgress::stage) stage, uint64_t done, uint64_t total) const {
    if (observer_ && !observer_({stage, done, total})) throw FrameStopped();
  }

 private:
  FrameObserver observer_;
};

}  // namespace wavetracer
