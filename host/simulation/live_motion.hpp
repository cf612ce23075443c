// SPDX-License-Identifier: Apache-2.0
// The motion of a live vehicle between two frames: its poses, and the way by which its parts turn.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "motion/pose.hpp"
#include "motion/travel.hpp"
#include "wavetracer/live.hpp"

namespace wavetracer {

// This is faster than any vehicle on the ground: such a step is a jump, whose speed would give meaningless Doppler
// shifts.
constexpr double live_jump_m_s = 150;

// The angular velocity that turns one orientation into the other, the shorter way, in this time.
glm::dvec3 live_turning(const glm::dquat& from, const glm::dquat& to, double seconds);

// Quaternions that have unit length up to rounding stay unchanged.
glm::dquat live_unit(const glm::dquat& q);

// The pose at the share u of the way between two poses; see LivePlaces::between. File coordinates.
Pose live_pose(const LiveTraffic::Vehicle& from, const LiveTraffic::Vehicle& to, double duration_s, double u);

// The integrals and velocities at that share: those of `from`, and the way on the poses between both. A way that the
// later frame tells is reached evenly. A vehicle that jumps does not travel.
Travelled live_travelled(const LiveTraffic::Vehicle& from, const LiveTraffic::Vehicle& to, double duration_s, double u);

}  // namespace wavetracer
