// Checks of a whole Config: what no single key shows, such as keys that exclude each other and names that are taken.
// Assumes that every value by itself is one that the field table accepts.
#pragma once
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer::config {

struct Contradiction {
  std::vector<std::string> keys;  // trace.rays, track.0.waypoints, mount.0; the one that stands last is to blame
  std::string what;
};

std::vector<Contradiction> contradictions(const Config& config);

// Of array_checks.cpp: a part of them, what concerns arrays and several carriers.
void check_arrays(const Config& config, std::vector<Contradiction>& out);
// Of vehicle_checks.cpp: what concerns vehicles and the time of their drive.
void check_trajectories(const Config& config, std::vector<Contradiction>& out);
// Of place_checks.cpp.
void check_air(const Config& config, std::vector<Contradiction>& out);
void check_degrees(const Config& config, std::vector<Contradiction>& out);
void check_grid_corners(const Config& config, std::vector<Contradiction>& out);

}  // namespace wavetracer::config
