// SPDX-License-Identifier: Apache-2.0
// Converts the reference point of another program to the centre of the footprint of a vehicle.
// Roll is ignored.
#pragma once
#include <cmath>
#include <glm/vec3.hpp>

#include "motion/track_motion.hpp"

namespace wavetracer {

// Turns `arm` (ahead, left, up of a vehicle with this yaw and pitch, nose up) into the axes of the scene.
inline glm::dvec3 turned_arm(const glm::dvec3& arm, double yaw_rad, double pitch_rad) {
  const glm::dvec3 ahead = heading(yaw_rad, pitch_rad), left(-std::sin(yaw_rad), std::cos(yaw_rad), 0);
  const glm::dvec3 up(-std::sin(pitch_rad) * std::cos(yaw_rad), -std::sin(pitch_rad) * std::sin(yaw_rad),
                      std::cos(pitch_rad));
  return arm.x * ahead + arm.y * left + arm.z * up;
}

// Tells whether a file's length, width and height can be those of a vehicle.
inline bool is_size(const glm::dvec3& size_m) {
  constexpr double longest_m = 1000;
  for (int axis = 0; axis < 3; ++axis)
    if (!(size_m[axis] > 0 && size_m[axis] <= longest_m)) return false;
  return true;
}

}  // namespace wavetracer
