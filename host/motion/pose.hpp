// SPDX-License-Identifier: Apache-2.0
// Poses between the samples of a track: they are smooth, and equal the samples at their times.
// The track must be finished: every value of its samples is given, and its segments are set.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "motion/trajectories.hpp"

namespace wavetracer {

struct Pose {
  glm::dvec3 position_m;              // centre of the footprint, on the ground
  glm::dquat orientation;             // rotates from the vehicle's axes (x ahead, y left, z up) to the scene's
  glm::dvec3 velocity_m_s;            // exact derivative of position_m
  glm::dvec3 angular_velocity_rad_s;  // in the scene's axes; a point at r from position_m moves with v + cross(w, r)
};

// A cubic over [0, duration_s] that starts at 0 with slope a and ends at `rise` with slope b, and its derivative.
template <class T>
struct Cubic {
  T value, rate;
  Cubic(const T& rise, const T& a, const T& b, double duration_s, double u)
      : value((u * u * (3 - 2 * u)) * rise + (duration_s * u * (1 - u)) * ((1 - u) * a - u * b)),
        rate((6 * u * (1 - u) / duration_s) * rise + ((1 - u) * (1 - 3 * u)) * a + (u * (3 * u - 2)) * b) {}
};

// Between samples the position is the cubic that has their positions and velocities, so position and velocity are
// continuous. Yaw goes the shorter way round; yaw and pitch are monotone cubics with continuous rates (F. N. Fritsch
// and J. Butland, SIAM J. Sci. Stat. Comput. 5(2), 1984), which never turn farther than the samples do.
// The pose is absent before the vehicle appears, after it vanishes, and between segments; a time within
// time_tolerance_s() of an end of a segment counts as that end.
std::optional<Pose> pose_at(const Track& track, double time_s);

}  // namespace wavetracer
