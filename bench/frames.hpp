// SPDX-License-Identifier: Apache-2.0
// Measures warm frames of a simulation: the first one separately, then the median of the rest by wall time.
// Nothing else may run on the device.
#pragma once
#include <cstddef>

#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {

struct Frames {
  double first_s = 0;   // a cold frame: buffers are allocated, drivers finish compiling
  double median_s = 0;  // median of the frames after it
  FrameResult result;   // result of the last frame
};

// Solves frame 0 once and then `count` times more, count >= 1.
Frames run_frames(Simulation& simulation, size_t count);

}  // namespace wavetracer::bench
