// SPDX-License-Identifier: Apache-2.0
// Bounds of the motion of a drive between two times.
#pragma once
#include "simulation/world.hpp"

namespace wavetracer {

// As Simulation::motion_m(). Between samples a vehicle's place is a cubic, which stays among its four control points,
// and its angles turn one way (motion/pose.hpp); so the bound holds at all times between, and not only at the two.
double motion_bound_m(const World& world, double from_s, double to_s);

}  // namespace wavetracer
