// SPDX-License-Identifier: Apache-2.0
// Interpolates position, yaw and pitch by cubic Hermite polynomials, each with its derivative.
// Differences of positions should be small beside the positions: sums are written as sample plus difference.
#include "motion/pose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/times.hpp"

namespace wavetracer {
namespace {

struct Curve {
  double value, rate;
};

// Returns the difference between the angles of two samples, the shorter way round for yaw.
double turn(const Sample& from, const Sample& to, double Sample::*angle) {
  return std::remainder(to.*angle - from.*angle, 2 * std::numbers::pi);
}

bool starts_segment(const Track& track, size_t k) {
  return std::binary_search(track.segments.begin(), track.segments.end(), static_cast<uint32_t>(k));
}

// Returns the rate of an angle at sample k: the weighted harmonic mean of the rates before and after (Fritsch and
// Butland), zero if they differ in sign; at an end of a segment, the one rate that exists.
double rate_at(const Track& track, size_t k, double Sample::*angle) {
  const std::vector<Sample>& s = track.samples;
  const bool has_before = !starts_segment(track, k);
  const bool has_after = k + 1 < s.size() && !starts_segment(track, k + 1);
  const double before_s = has_before ? s[k].time_s - s[k - 1].time_s : 0;
  const double after_s = has_after ? s[k + 1].time_s - s[k].time_s : 0;
  const double before = has_before ? turn(s[k - 1], s[k], angle) / before_s : 0;
  const double after = has_after ? turn(s[k], s[k + 1], angle) / after_s : 0;
  if (!has_before || !has_after) return before + after;
  if (!(before * after > 0)) return 0;
  const double w = (before_s + 2 * after_s) / (3 * (before_s + after_s));
  return before * after / (w * after + (1 - w) * before);
}

Pose make_pose(const glm::dvec3& position_m, const glm::dvec3& velocity_m_s, Curve yaw, Curve pitch) {
  // A rotation about z by yaw is applied after one about y by -pitch: a positive rotation about y would lower the nose.
  const glm::dquat turned(std::cos(yaw.value / 2), 0, 0, std::sin(yaw.value / 2));
  const glm::dquat tilted(std::cos(pitch.value / 2), 0, -std::sin(pitch.value / 2), 0);
  const glm::dvec3 left(-std::sin(yaw.value), std::cos(yaw.value), 0);
  return {position_m, turned * tilted, velocity_m_s, glm::dvec3(0, 0, yaw.rate) - pitch.rate * left};
}

Pose sample_pose(const Track& track, size_t k) {
  const Sample& s = track.samples[k];
  return make_pose(s.position_m, s.velocity_m_s, {s.yaw_rad, rate_at(track, k, &Sample::yaw_rad)},
                   {s.pitch_rad, rate_at(track, k, &Sample::pitch_rad)});
}

Pose pose_between(const Track& track, size_t k, double time_s) {
  const Sample &a = track.samples[k], &b = track.samples[k + 1];
  const double duration_s = b.time_s - a.time_s, u = (time_s - a.time_s) / duration_s;
  const auto angle = [&](double Sample::*member) {
    const Cubic<double> c(turn(a, b, member), rate_at(track, k, member), rate_at(track, k + 1, member), duration_s, u);
    return Curve{a.*member + c.value, c.rate};
  };
  const Cubic<glm::dvec3> way(b.position_m - a.position_m, a.velocity_m_s, b.velocity_m_s, duration_s, u);
  return make_pose(a.position_m + way.value, way.rate, angle(&Sample::yaw_rad), angle(&Sample::pitch_rad));
}

}  // namespace

std::optional<Pose> pose_at(const Track& track, double time_s) {
  const std::vector<Sample>& samples = track.samples;
  const auto later = std::upper_bound(samples.begin(), samples.end(), time_s,
                                      [](double time, const Sample& s) { return time < s.time_s; });
  const double tolerance_s = time_tolerance_s(time_s);
  const size_t after = static_cast<size_t>(later - samples.begin());
  const bool has_before = after > 0, has_after = after < samples.size();
  if (has_before && samples[after - 1].time_s == time_s) return sample_pose(track, after - 1);
  if (has_before && has_after && !starts_segment(track, after)) return pose_between(track, after - 1, time_s);
  if (has_before && time_s <= samples[after - 1].time_s + tolerance_s) return sample_pose(track, after - 1);
  if (has_after && time_s >= samples[after].time_s - tolerance_s) return sample_pose(track, after);
  return std::nullopt;
}

}  // namespace wavetracer
