// SPDX-License-Identifier: Apache-2.0
// Frames without a vehicle are counted by the first and the last one that has some, not one by one.
#include "simulation/world_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/times.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

std::string range_in_words(const TimeConfig& config) {
  if (!config.start_s) return fmt::format("ends at {} s", time_text(config.end_s.value_or(0)));
  if (!config.end_s) return fmt::format("begins at {} s", time_text(*config.start_s));
  return fmt::format("goes from {} to {} s", time_text(*config.start_s), time_text(*config.end_s));
}

}  // namespace

FrameClock make_clock(const TimeConfig& config, const Trajectories& trajectories) {
  const double first_s = trajectories.first_time_s, last_s = trajectories.last_time_s;
  const double start_s = config.start_s.value_or(first_s), end_s = config.end_s.value_or(last_s);
  if (start_s > last_s + time_tolerance_s(last_s) || end_s < first_s - time_tolerance_s(first_s))
    throw ConfigError(
        fmt::format("[time] {}, and the trajectories go from {} to {} s: no frame would have a vehicle; "
                    "give a time.start_s and a time.end_s within that range, or leave both out",
                    range_in_words(config), time_text(first_s), time_text(last_s)));
  const double step_s = config.step_s.value_or(trajectories.step_s);
  if (!(step_s > 0) && start_s != end_s)
    throw ConfigError(
        "time.step_s is not given, and no vehicle has two samples from which it follows: give time.step_s");
  return {start_s, end_s, step_s > 0 ? step_s : 1};
}

std::vector<std::string> empty_frames_warning(const TimeConfig& config, const Trajectories& trajectories,
                                              const FrameClock& clock) {
  const double first_s = trajectories.first_time_s, last_s = trajectories.last_time_s;
  const double start_s = config.start_s.value_or(first_s);
  const double frames = static_cast<double>(clock.frame_count()), step = clock.step_s();
  const double before = std::clamp(std::ceil((first_s - time_tolerance_s(first_s) - start_s) / step), 0.0, frames);
  const double until = std::clamp(std::floor((last_s + time_tolerance_s(last_s) - start_s) / step) + 1, before, frames);
  const double empty = frames - (until - before);
  if (!(empty > 0)) return {};
  return {fmt::format("{} of {} frames have no vehicle: [time] {}, and the trajectories go from {} to {} s", empty,
                      frames, range_in_words(config), time_text(first_s), time_text(last_s))};
}

}  // namespace wavetracer
