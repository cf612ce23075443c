// SPDX-License-Identifier: Apache-2.0
// Sorts tracks, cuts segments, and computes headings and velocities from differences of positions, for samples at any
// spacing.
#include "motion/track_motion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/times.hpp"

namespace wavetracer {
namespace {

constexpr double standing_m = 1e-3;  // a vehicle that moves less than this between two samples stands
constexpr double gap_steps = 1.5;
// A jump is longer than the sum of three distances: by the higher of both speeds, with this factor since it may be
// higher in between,
constexpr double jump_factor = 1.5;
constexpr double jump_acceleration_m_s2 = 10;  // by braking or starting, harder than any tyre allows,
constexpr double jump_margin_m = 5;            // and by a change of lanes, which SUMO makes in one step.

double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void append_steps(const Track& track, std::vector<double>& steps_s) {
  for (size_t k = 1; k < track.samples.size(); ++k) {
    steps_s.push_back(track.samples[k].time_s - track.samples[k - 1].time_s);
  }
}

// Returns the step without rounding. Near 1.7e9 s a step of 0.1 s reads as 0.10000014 s, so after some hundred thousand
// frames no frame would fall on a sample. In such a case, the step is the mean of the longest run of equally spaced
// samples, in as few digits as its error allows.
double unrounded_step(const std::vector<Track>& tracks, double step_s, double largest_s) {
  constexpr double negligible = 1e-9;  // share of a step
  const double error_s = time_spacing_s(largest_s);
  if (!(error_s > negligible * step_s)) return step_s;
  double run_s = step_s, steps = 1;
  for (const Track& track : tracks) {
    size_t first = 0;
    for (size_t k = 1; k < track.samples.size(); ++k) {
      if (std::abs(track.samples[k].time_s - track.samples[k - 1].time_s - step_s) > 2 * error_s) first = k;
      if (static_cast<double>(k - first) <= steps) continue;
      steps = static_cast<double>(k - first);
      run_s = track.samples[k].time_s - track.samples[first].time_s;
    }
  }
  return simplest_decimal(run_s / steps, error_s / steps);
}

bool is_jump(const Sample& a, const Sample& b, double max_speed_m_s) {
  const double time_s = b.time_s - a.time_s;
  const double speed_m_s = std::isnan(a.speed_m_s) || std::isnan(b.speed_m_s)
                               ? max_speed_m_s
                               : jump_factor * std::max(std::abs(a.speed_m_s), std::abs(b.speed_m_s));
  const double reach_m = speed_m_s * time_s + jump_acceleration_m_s2 / 2 * time_s * time_s + jump_margin_m;
  return glm::distance(a.position_m, b.position_m) > reach_m;
}

// The motion around sample k of the segment [first, end).
struct LocalMotion {
  glm::dvec3 velocity_m_s{0};
  bool moves = false;   // before or after the sample
  bool stands = false;  // before or after the sample
};

LocalMotion local_motion(const std::vector<Sample>& samples, size_t first, size_t end, size_t k) {
  LocalMotion out;
  double weight = 0;
  const auto look = [&](size_t from, double other_step_s) {
    const glm::dvec3 way_m = samples[from + 1].position_m - samples[from].position_m;
    const bool moves = glm::length(way_m) > standing_m;
    out.moves |= moves;
    out.stands |= !moves;
    out.velocity_m_s += other_step_s * (way_m / (samples[from + 1].time_s - samples[from].time_s));
    weight += other_step_s;
  };
  const double before_s = k > first ? samples[k].time_s - samples[k - 1].time_s : 0;
  const double after_s = k + 1 < end ? samples[k + 1].time_s - samples[k].time_s : 0;
  if (before_s > 0) look(k - 1, after_s > 0 ? after_s : 1);
  if (after_s > 0) look(k, before_s > 0 ? before_s : 1);
  if (weight > 0) out.velocity_m_s /= weight;
  return out;
}

// Calls visit(k, motion) for every sample, segment by segment.
template <class Visit>
void for_each_motion(const Track& track, const Visit& visit) {
  for (size_t s = 0; s < track.segments.size(); ++s) {
    const size_t first = track.segments[s];
    const size_t end = s + 1 < track.segments.size() ? track.segments[s + 1] : track.samples.size();
    for (size_t k = first; k < end; ++k) visit(k, local_motion(track.samples, first, end, k));
  }
}

// A sample without a value takes that of the sample before it, or of the first one that has a value.
// Returns true if none has one.
bool carry_over(std::vector<Sample>& samples, double Sample::*member) {
  const auto known = [&](const Sample& s) { return !std::isnan(s.*member); };
  const auto found = std::find_if(samples.begin(), samples.end(), known);
  double value = found == samples.end() ? 0 : *found.*member;
  for (Sample& s : samples) {
    if (known(s)) value = s.*member;
    s.*member = value;
  }
  return found == samples.end();
}

}  // namespace

glm::dvec3 heading(double yaw_rad, double pitch_rad) {
  return {std::cos(pitch_rad) * std::cos(yaw_rad), std::cos(pitch_rad) * std::sin(yaw_rad), std::sin(pitch_rad)};
}

double median_step(const std::vector<Track>& tracks) {
  std::vector<double> steps_s;
  for (const Track& track : tracks) append_steps(track, steps_s);
  return median(steps_s);
}

void set_order(Trajectories& trajectories) {
  std::vector<Track>& tracks = trajectories.tracks;
  std::sort(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) {
    const double time_a = a.samples.front().time_s, time_b = b.samples.front().time_s;
    return time_a != time_b ? time_a < time_b : a.id < b.id;
  });
  trajectories.first_time_s = trajectories.last_time_s = tracks.front().samples.front().time_s;
  for (const Track& track : tracks) {
    trajectories.last_time_s = std::max(trajectories.last_time_s, track.samples.back().time_s);
  }
  const double largest_s = std::max(std::abs(trajectories.first_time_s), std::abs(trajectories.last_time_s));
  trajectories.step_s = unrounded_step(tracks, median_step(tracks), largest_s);
}

std::optional<double> split_segments(Track& track, double step_s, double max_speed_m_s,
                                     const std::vector<double>& frames_s) {
  if (track.samples.size() >= 4) {
    std::vector<double> steps_s;
    append_steps(track, steps_s);
    step_s = std::max(step_s, median(steps_s));
  }
  track.segments = {0};
  for (size_t k = 1; k < track.samples.size(); ++k) {
    const Sample &a = track.samples[k - 1], &b = track.samples[k];
    const auto next = std::ranges::upper_bound(frames_s, a.time_s);
    const bool gap =
        frames_s.empty() ? b.time_s - a.time_s > gap_steps * step_s : next != frames_s.end() && *next < b.time_s;
    if (gap || is_jump(a, b, max_speed_m_s)) {
      track.segments.push_back(static_cast<uint32_t>(k));
    }
  }
  if (track.segments.size() == 1) return std::nullopt;
  return track.samples[track.segments[1] - 1].time_s;
}

bool complete_headings(Track& track) {
  std::vector<Sample>& samples = track.samples;
  for_each_motion(track, [&](size_t k, const LocalMotion& motion) {
    const glm::dvec3& v = motion.velocity_m_s;
    const double level = std::hypot(v.x, v.y);
    if (!motion.moves || level < 1e-6) return;  // it stands, turns back, or goes straight up
    Sample& s = samples[k];
    if (std::isnan(s.yaw_rad)) s.yaw_rad = std::atan2(v.y, v.x);
    if (std::isnan(s.pitch_rad)) {
      const double along = v.x * std::cos(s.yaw_rad) + v.y * std::sin(s.yaw_rad);
      s.pitch_rad = std::atan(v.z / std::copysign(level, along));  // the nose is down if it reverses uphill
    }
  });
  carry_over(samples, &Sample::pitch_rad);  // a vehicle that never moves is level
  return carry_over(samples, &Sample::yaw_rad);
}

void shift_to_centre(Track& track, double length_m) {
  for (Sample& s : track.samples) s.position_m -= length_m / 2 * heading(s.yaw_rad, s.pitch_rad);
}

glm::dvec3 turned_arm(const glm::dvec3& arm, double yaw_rad, double pitch_rad) {
  const glm::dvec3 ahead = heading(yaw_rad, pitch_rad), left(-std::sin(yaw_rad), std::cos(yaw_rad), 0);
  const glm::dvec3 up(-std::sin(pitch_rad) * std::cos(yaw_rad), -std::sin(pitch_rad) * std::sin(yaw_rad),
                      std::cos(pitch_rad));
  return arm.x * ahead + arm.y * left + arm.z * up;
}

bool is_size(const glm::dvec3& size_m) {
  constexpr double longest_m = 1000;
  for (int axis = 0; axis < 3; ++axis)
    if (!(size_m[axis] > 0 && size_m[axis] <= longest_m)) return false;
  return true;
}

void complete_velocities(Track& track) {
  for_each_motion(track, [&](size_t k, const LocalMotion& motion) {
    Sample& s = track.samples[k];
    if (!std::isnan(s.speed_m_s)) {
      s.velocity_m_s = s.speed_m_s * heading(s.yaw_rad, s.pitch_rad);
      return;
    }
    s.velocity_m_s = motion.stands ? glm::dvec3(0) : motion.velocity_m_s;
    const bool reverse = glm::dot(s.velocity_m_s, heading(s.yaw_rad, s.pitch_rad)) < 0;
    s.speed_m_s = (reverse ? -1 : 1) * glm::length(s.velocity_m_s);
  });
}

}  // namespace wavetracer
