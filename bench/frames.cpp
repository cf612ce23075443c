// SPDX-License-Identifier: Apache-2.0
// Measures wall time around Simulation::run_frame, so that host stages count as well as kernels.
// The clock is steady; the median of an even number of frames is the mean of the two in the middle.
#include "frames.hpp"

#include <algorithm>
#include <chrono>
#include <vector>

namespace wavetracer::bench {
namespace {

double run_one(Simulation& simulation, FrameResult& result) {
  const auto start = std::chrono::steady_clock::now();
  simulation.give_back(result);
  result = simulation.run_frame(0);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Frames run_frames(Simulation& simulation, size_t count) {
  Frames frames;
  frames.first_s = run_one(simulation, frames.result);
  std::vector<double> seconds(count);
  for (double& one : seconds) one = run_one(simulation, frames.result);
  std::sort(seconds.begin(), seconds.end());
  frames.median_s = 0.5 * (seconds[(count - 1) / 2] + seconds[count / 2]);
  return frames;
}

}  // namespace wavetracer::bench
