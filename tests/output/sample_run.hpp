// A small made-up run for the output tests: two frames, two transmitters, two receivers, five paths, mixed ports.
// Its values are simple functions of the row, which read_paths.py computes again.
#pragma once
#include "output/output.hpp"

namespace wavetracer {

struct SampleRun {
  Config config;
  Scene scene;
  SampleRun();
  // Frame 7 at 0 s with three paths, frame 8 at 0.1 s with two.
  RunData data() const;
  // The same ends, one frame, no path.
  RunData empty() const;
};

}  // namespace wavetracer
