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

// The cubic over [0, duration_s] that starts at 0 with slope a and ends at `rise` with slope b, and its derivative.
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
// Absent before the vehicle appears, after it vanishes, and between segments; a time within time_tolerance_s() of an
// end of a segment is that end.
std::optional<Pose> pose_at(const Track& track, double time_s);

}  // namespace wavetracer
