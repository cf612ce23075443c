// SPDX-License-Identifier: Apache-2.0
// Warnings about ends and vehicles at places that cannot be intended: inside of houses, below the ground, far outside.
// They come before anything is traced, and name a few of each kind and then the number of the others.
#pragma once
#include <string>
#include <vector>

#include "simulation/surroundings.hpp"
#include "simulation/world.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Warnings about the fixed ends of a configuration, as it was loaded.
std::vector<std::string> place_warnings(const Config& config, const Surroundings& around, const World& world);

// Warnings about vehicles, at the frames of the drive, or at evenly spread ones if there are many.
std::vector<std::string> vehicle_warnings(const Surroundings& around, const World& world);

}  // namespace wavetracer
