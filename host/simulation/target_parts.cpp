// SPDX-License-Identifier: Apache-2.0
// A wheel touches the ground at rest: its angle is the way of its centre, along the direction in which it rolls, over
// its radius. In a curve the outer wheel goes farther, which Travelled::turn_rad says.
#include "simulation/target_parts.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace wavetracer {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

}  // namespace

PartPoint point_of_part(const TargetPartConfig& part, uint32_t point) {
  const auto vector = [](const std::array<double, 3>& v) { return glm::dvec3(v[0], v[1], v[2]); };
  const glm::dvec3 axis = glm::normalize(vector(part.axis));
  PartPoint out;
  out.wheel = part.wheel();
  out.pivot_m = vector(part.pivot_m);
  out.ahead = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1)));
  out.up = glm::cross(out.ahead, axis);
  out.phase_rad = part.phase_deg * (full_turn / 360);
  const double share = static_cast<double>(point) / part.points;
  if (out.wheel) {
    out.arm_m = *part.radius_m;
    out.period_m = full_turn * *part.radius_m;
    out.phase_rad += full_turn * share;
  } else {
    out.arm_m = *part.length_m * (static_cast<double>(point + 1) / part.points);
    out.period_m = *part.stride_m;
    out.swing_rad = *part.swing_deg * (full_turn / 360);
  }
  return out;
}

PartPlace place_of(const PartPoint& point, const Travelled& travelled) {
  glm::dvec3 way_m = travelled.way_m, velocity_m_s = travelled.velocity_m_s;
  if (point.wheel) {
    way_m += glm::cross(travelled.turn_rad, point.pivot_m);
    velocity_m_s += glm::cross(travelled.rate_rad_s, point.pivot_m);
  }
  const double per_metre = full_turn / point.period_m;
  const double phase = point.phase_rad + glm::dot(way_m, point.ahead) * per_metre;
  const double rate = glm::dot(velocity_m_s, point.ahead) * per_metre;
  double angle = phase, turning = rate;  // from the upper end of a wheel, or of a limb that hangs down, towards ahead
  if (!point.wheel) {
    angle = std::numbers::pi - point.swing_rad * std::sin(phase);
    turning = -point.swing_rad * std::cos(phase) * rate;
  }
  const double sine = std::sin(angle), cosine = std::cos(angle);
  return {point.pivot_m + point.arm_m * (sine * point.ahead + cosine * point.up),
          point.arm_m * turning * (cosine * point.ahead - sine * point.up)};
}

}  // namespace wavetracer
