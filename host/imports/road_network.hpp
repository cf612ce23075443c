// The lanes of a SUMO network as streets.
#pragma once
#include <filesystem>
#include <vector>

#include "scene/streets.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// The lanes of a .net.xml, plain or gzip, also those across junctions, but no crossings and areas of pedestrians; in
// the coordinates of the network. Lanes without a width have SUMO's 3.2 m. Throws InputError, "FILE:LINE: what", for a
// file that is no network, and for one of more than 1 GiB of text.
std::vector<Street> read_road_network(const std::filesystem::path& file);

// The streets that the configuration knows, in the coordinates of the scene file: those of scene.streets, which moves
// like trajectories.file, else those of a generated city, else none. Throws as read_road_network() does.
std::vector<Street> known_streets(const Config& config);

}  // namespace wavetracer
