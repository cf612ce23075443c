// SPDX-License-Identifier: Apache-2.0
// Reads the lanes of a SUMO network as streets.
#pragma once
#include <filesystem>
#include <vector>

#include "scene/streets.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Returns the lanes of a .net.xml, plain or gzip, including those across junctions, but without pedestrian crossings
// and areas; in the coordinates of the network. Lanes without a width get SUMO's 3.2 m. Throws InputError, "FILE:LINE:
// what", for a file that is no network or has more than 1 GiB of text.
std::vector<Street> read_road_network(const std::filesystem::path& file);

// Returns the streets of the configuration, in the coordinates of the scene file: those of scene.streets, which are
// moved like trajectories.file, else those of a generated city, else none. Throws as read_road_network() does.
std::vector<Street> known_streets(const Config& config);

}  // namespace wavetracer
