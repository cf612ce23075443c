// SPDX-License-Identifier: Apache-2.0
// Positions are cubics through the positions and velocities of both frames; a vehicle turns evenly.
#include "simulation/live_motion.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace wavetracer {

glm::dvec3 live_turning(const glm::dquat& from, const glm::dquat& to, double seconds) {
  glm::dquat turn = to * glm::conjugate(from);
  if (turn.w < 0) turn = -turn;
  const glm::dvec3 axis(turn.x, turn.y, turn.z);
  const double sine = glm::length(axis);
  return sine > 0 ? axis * (2 * std::atan2(sine, turn.w) / sine / seconds) : glm::dvec3(0);
}

glm::dquat live_unit(const glm::dquat& q) { return std::abs(glm::dot(q, q) - 1) <= 1e-12 ? q : glm::normalize(q); }

Pose live_pose(const LiveTraffic::Vehicle& from, const LiveTraffic::Vehicle& to, double duration_s, double u) {
  const glm::dvec3 way_m = to.position_m - from.position_m, even_m_s = way_m / duration_s;
  if (glm::length(even_m_s) > live_jump_m_s) {
    const LiveTraffic::Vehicle& at = u < 1 ? from : to;
    return {at.position_m, at.orientation, glm::dvec3(0), glm::dvec3(0)};
  }
  const Cubic<glm::dvec3> cubic(way_m, from.velocity_m_s.value_or(even_m_s), to.velocity_m_s.value_or(even_m_s),
                                duration_s, u);
  const glm::dvec3 turn_rad_s = live_turning(from.orientation, to.orientation, duration_s);
  const double rate = glm::length(turn_rad_s);
  const glm::dquat turned =
      rate > 0 ? glm::angleAxis(rate * duration_s * u, turn_rad_s / rate) * from.orientation : from.orientation;
  return {from.position_m + cubic.value, live_unit(turned), cubic.rate, turn_rad_s};
}

Travelled live_travelled(const LiveTraffic::Vehicle& from, const LiveTraffic::Vehicle& to, double duration_s,
                         double u) {
  Travelled out{.way_m = from.way_m, .turn_rad = from.turn_rad};
  if (!(duration_s > 0) || glm::length(to.position_m - from.position_m) > live_jump_m_s * duration_s) return out;
  const auto pose = [&](double time_s) -> std::optional<Pose> {
    return live_pose(from, to, duration_s, time_s / duration_s);
  };
  add_way(out, pose, 0, u * duration_s);
  if (u < 1) {
    Travelled whole{.way_m = from.way_m, .turn_rad = from.turn_rad};
    add_way(whole, pose, 0, duration_s);
    out.way_m += u * (to.way_m - whole.way_m);
    out.turn_rad += u * (to.turn_rad - whole.turn_rad);
  }
  const Travelled now = velocities_of(live_pose(from, to, duration_s, u));
  out.velocity_m_s = now.velocity_m_s;
  out.rate_rad_s = now.rate_rad_s;
  return out;
}

}  // namespace wavetracer
