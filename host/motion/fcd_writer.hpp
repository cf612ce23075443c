// SPDX-License-Identifier: Apache-2.0
// Writes trajectories as SUMO does (FCD), for other tools and for read.hpp.
// Steps must be longer than a microsecond. Types are written by name: a reader must know their sizes.
#pragma once
#include <string>

#include "motion/trajectories.hpp"

namespace wavetracer {

// Writes as with --precision 6: centre of the front bumper, compass angle, speed, slope and type.
std::string format_fcd(const Trajectories& trajectories);

}  // namespace wavetracer
