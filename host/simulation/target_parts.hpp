// SPDX-License-Identifier: Apache-2.0
// Points of targets that move on their vehicle: the rims of wheels and limbs, by [[target_part]].
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>

#include "motion/travel.hpp"
#include "wavetracer/target_config.hpp"

namespace wavetracer {

// A point of a part: all that its place depends on besides the way of its vehicle, in the vehicle's axes.
struct PartPoint {
  glm::dvec3 pivot_m{0}, ahead{0}, up{0};  // ahead and up are at right angles to the axis
  double arm_m = 0;                        // its distance from the pivot
  double phase_rad = 0;
  double swing_rad = 0;  // the largest angle of a limb; 0 on a wheel
  double period_m = 1;   // the way of a full turn, 2 pi times the radius, or of a full swing
  bool wheel = true;
};

// Point number `point` of the part, which is without contradictions (config/target_checks.cpp).
PartPoint point_of_part(const TargetPartConfig& part, uint32_t point);

// The place of the point from the middle of the footprint, and how fast it moves along the vehicle's axes. The second
// is the exact derivative of the first by time.
struct PartPlace {
  glm::dvec3 arm_m, velocity_m_s;
};
PartPlace place_of(const PartPoint& point, const Travelled& travelled);

}  // namespace wavetracer
