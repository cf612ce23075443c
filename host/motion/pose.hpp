// Poses between the samples of a track: smooth, and the samples' own at their times.
// Assumes a finished track: every value of its samples is given, its segments are set.
#pragma once
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "motion/trajectories.hpp"

namespace wavetracer {

struct Pose {
  glm::dvec3 position_m;              // centre of the footprint, on the ground
  glm::dquat orientation;             // from the vehicle (x ahead, y left, z up) to the scene
  glm::dvec3 velocity_m_s;            // of position_m, its exact derivative
  glm::dvec3 angular_velocity_rad_s;  // in the scene's axes; a point at r from position_m moves with v + cross(w, r)
};

// A time this near to an end of a segment is that end: k * step is not the decimal number of a file to the last bit.
inline constexpr double time_tolerance_s = 1e-6;

// Between samples the position is the cubic that has their positions and velocities, so position and velocity are
// continuous. Yaw goes the shorter way round; yaw and pitch are monotone cubics with continuous rates (F. N. Fritsch
// and J. Butland, SIAM J. Sci. Stat. Comput. 5(2), 1984), which never turn farther than the samples do.
// Absent before the vehicle appears, after it vanishes, and between segments.
std::optional<Pose> pose_at(const Track& track, double time_s);

}  // namespace wavetracer
