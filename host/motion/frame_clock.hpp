// The instants that frames show, and who is there in each.
// Assumes finished trajectories: tracks in order of their first sample.
#pragma once
#include <cstdint>
#include <vector>

#include "motion/pose.hpp"

namespace wavetracer {

// Frames at first_time_s + k * step_s up to last_time_s, which is a frame itself where only rounding says no: that of
// the sum, and that of both times, which doubles keep the worse the larger they are.
class FrameClock {
 public:
  // Throws ConfigError unless the step is positive, the end not before the beginning, frames fewer than 2^53, and times
  // precise enough for the step.
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

// The vehicles that are present at a time, in the order of their tracks.
std::vector<PresentVehicle> vehicles_at(const Trajectories& trajectories, double time_s);

}  // namespace wavetracer
