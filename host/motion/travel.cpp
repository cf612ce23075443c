// SPDX-License-Identifier: Apache-2.0
// Between samples a pose is smooth, so Gauss's rule with eight points gives the integrals to rounding, and their
// derivatives are the velocities. A vehicle that goes straight on has constant or linear terms, for which the rule is
// exact.
#include "motion/travel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace wavetracer {
namespace {

// Abscissae and weights on [-1, 1] of the rule of Gauss and Legendre with eight points (M. Abramowitz and I. Stegun,
// Handbook of Mathematical Functions, table 25.4); each belongs to both signs.
constexpr std::array<std::pair<double, double>, 4> rule{{{0.1834346424956498, 0.3626837833783620},
                                                         {0.5255324099163290, 0.3137066458778873},
                                                         {0.7966664774136267, 0.2223810344533745},
                                                         {0.9602898564975363, 0.1012285362903763}}};

void add_over(Travelled& sum, const Track& track, double from_s, double to_s) {
  add_way(
      sum, [&](double time_s) { return pose_at(track, time_s); }, from_s, to_s);
}

bool continues(const Track& track, size_t sample) {
  return !std::binary_search(track.segments.begin(), track.segments.end(), static_cast<uint32_t>(sample));
}

}  // namespace

Travelled velocities_of(const Pose& pose) {
  const glm::dquat back = glm::conjugate(pose.orientation);
  return {.velocity_m_s = back * pose.velocity_m_s, .rate_rad_s = back * pose.angular_velocity_rad_s};
}

void add_way(Travelled& sum, const std::function<std::optional<Pose>(double)>& pose, double from_s, double to_s) {
  const double half_s = 0.5 * (to_s - from_s), middle_s = 0.5 * (from_s + to_s);
  for (const auto& [place, weight] : rule)
    for (const double side : {-1.0, 1.0}) {
      const auto at = pose(middle_s + side * place * half_s);
      if (!at) continue;
      const Travelled now = velocities_of(*at);
      sum.way_m += now.velocity_m_s * (weight * half_s);
      sum.turn_rad += now.rate_rad_s * (weight * half_s);
    }
}

Travel::Travel(const Track& track) : at_samples_(track.samples.size()) {
  for (size_t k = 1; k < track.samples.size(); ++k) {
    at_samples_[k] = at_samples_[k - 1];
    if (continues(track, k)) add_over(at_samples_[k], track, track.samples[k - 1].time_s, track.samples[k].time_s);
  }
}

Travelled Travel::at(const Track& track, double time_s) const {
  const auto later = std::upper_bound(track.samples.begin(), track.samples.end(), time_s,
                                      [](double time, const Sample& s) { return time < s.time_s; });
  const auto after = static_cast<size_t>(later - track.samples.begin());
  Travelled out = at_samples_[after > 0 ? after - 1 : 0];
  if (after > 0 && after < track.samples.size() && continues(track, after))
    add_over(out, track, track.samples[after - 1].time_s, time_s);
  if (const auto pose = pose_at(track, time_s)) {
    const Travelled now = velocities_of(*pose);
    out.velocity_m_s = now.velocity_m_s;
    out.rate_rad_s = now.rate_rad_s;
  }
  return out;
}

}  // namespace wavetracer
