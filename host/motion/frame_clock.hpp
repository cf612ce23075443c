// SPDX-License-Identifier: Apache-2.0
// The times of frames, and the vehicles that are present in each.
// Trajectories must be finished: tracks in order of their first sample.
#pragma once
#include <cstdint>
#include <vector>

#include "motion/pose.hpp"

namespace wavetracer {

// Frames are at first_time_s + k * step_s up to last_time_s. The last time is itself a frame if only rounding excludes
// it: rounding of the sum and of both times, which grows with the times.
class FrameClock {
 public:
  // Throws ConfigError unless the step is positive, the end is not before the beginning, frames are fewer than 2^53,
  // and times are precise enough for the step.
  FrameClock(double first_time_s, double last_time_s, double step_s);

  uint64_t frame_count() const { return frame_count_; }
  double step_s() const { return step_s_; }
  double time_s(uint64_t frame) const;  // never after last_time_s; throws ConfigError past the last frame

 private:
  double first_time_s_, last_time_s_, step_s_;
  uint64_t frame_count_;
};

struct PresentVehicle {
  uint32_t track;  // index into Trajectories::tracks
  Pose pose;
};

// Returns the vehicles that are present at a time, in the order of their tracks.
std::vector<PresentVehicle> vehicles_at(const Trajectories& trajectories, double time_s);

}  // namespace wavetracer
