// Warnings about ends and vehicles at places that cannot be intended: inside of houses, below the ground, far
// outside. Given before anything is traced, by name, a few of each kind and then their number.
#pragma once
#include <string>
#include <vector>

#include "simulation/surroundings.hpp"
#include "simulation/world.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Warnings about the fixed ends of a configuration, as it was loaded.
std::vector<std::string> place_warnings(const Config& config, const Surroundings& around, const World& world);

// Those about vehicles, at the frames of the drive, or evenly spread ones where they are many.
std::vector<std::string> vehicle_warnings(const Surroundings& around, const World& world);

}  // namespace wavetracer
