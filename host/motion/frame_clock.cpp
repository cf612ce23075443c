// SPDX-License-Identifier: Apache-2.0
// Times of frames are computed by multiplication, never by summing steps, so that even the millionth frame has the
// right time.
#include "motion/frame_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/times.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

FrameClock::FrameClock(double first_time_s, double last_time_s, double step_s)
    : first_time_s_(first_time_s), last_time_s_(last_time_s), step_s_(step_s) {
  if (!(step_s > 0) || !std::isfinite(step_s)) {
    throw ConfigError(fmt::format("the time step of frames is {:g} s; it must be positive", step_s));
  }
  if (!(last_time_s >= first_time_s) || !std::isfinite(last_time_s - first_time_s)) {
    throw ConfigError(fmt::format("frames from {} s to {} s: the end must not be before the beginning",
                                  time_text(first_time_s), time_text(last_time_s)));
  }
  const double steps = (last_time_s - first_time_s) / step_s;
  constexpr double most = 9007199254740992;  // 2^53: doubles above it do not represent every whole number
  if (!(steps < most - 1)) throw ConfigError(fmt::format("{:g} frames are too many: use a longer time step", steps));
  const double largest_s = std::max(std::abs(first_time_s), std::abs(last_time_s)),
               rounding_s = time_spacing_s(largest_s);
  if (steps > 0 && !(step_s >= 4 * rounding_s)) {
    throw ConfigError(
        fmt::format("the time step of frames is {:g} s, but times near {} s are only known to {:.2g} s: "
                    "use a longer time step, or subtract the time of the beginning from all times",
                    step_s, time_text(largest_s), rounding_s));
  }
  frame_count_ = static_cast<uint64_t>(std::floor(steps + 1e-9 * std::max(1.0, steps) + rounding_s / step_s)) + 1;
}

double FrameClock::time_s(uint64_t frame) const {
  if (frame >= frame_count_) {
    throw ConfigError(fmt::format("there is no frame {}: the last one is {}", frame, frame_count_ - 1));
  }
  return std::min(first_time_s_ + static_cast<double>(frame) * step_s_, last_time_s_);
}

std::vector<PresentVehicle> vehicles_at(const Trajectories& trajectories, double time_s) {
  std::vector<PresentVehicle> out;
  for (size_t i = 0; i < trajectories.tracks.size(); ++i) {
    const Track& track = trajectories.tracks[i];
    if (track.samples.front().time_s > time_s + time_tolerance_s(time_s)) break;
    if (const auto pose = pose_at(track, time_s)) out.push_back({static_cast<uint32_t>(i), *pose});
  }
  return out;
}

}  // namespace wavetracer
