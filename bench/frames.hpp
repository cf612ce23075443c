// Warm frames of a simulation: the first one apart, then the median of the rest by wall time.
// Assumes that the caller has nothing else running on the device.
#pragma once
#include <cstddef>

#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {

struct Frames {
  double first_s = 0;   // cold: buffers are made, drivers finish compiling
  double median_s = 0;  // of the frames after it
  FrameResult result;   // of the last frame
};

// Solves frame 0 once and then `count` times more, count >= 1.
Frames run_frames(Simulation& simulation, size_t count);

}  // namespace wavetracer::bench
