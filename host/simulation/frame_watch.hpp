// Who watches a frame, and may end it: see Simulation::observe().
// Passes that take long say how far they are, between launches; nothing here waits for the device.
#pragma once
#include <utility>

#include "wavetracer/simulation.hpp"

namespace wavetracer {

class FrameWatch {
 public:
  void set(FrameObserver observer) { observer_ = std::move(observer); }
  // Throws FrameStopped where the observer wants no more.
  void tell(const char* stage, uint64_t done, uint64_t total) const {
    if (observer_ && !observer_({stage, done, total})) throw FrameStopped();
  }

 private:
  FrameObserver observer_;
};

}  // namespace wavetracer
