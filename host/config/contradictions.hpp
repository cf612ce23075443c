// SPDX-License-Identifier: Apache-2.0
// Checks a whole Config: problems that no single key shows, such as keys that exclude each other and names that are
// used twice. The field table has checked every value by itself.
#pragma once
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer::config {

struct Contradiction {
  // The keys, such as trace.rays, track.0.waypoints, mount.0; the one that comes last in the file is reported.
  std::vector<std::string> keys;
  std::string what;
};

std::vector<Contradiction> contradictions(const Config& config);

// Names the settings of [trace] that have no effect, because the feature that they belong to is off: one line each.
// They are no contradictions, so that a feature can be switched off and on by its one key.
std::vector<std::string> idle_settings(const Config& config);

// Says what needs rays, so that trace.discovery = "beams" is refused or "auto" takes none; empty: nothing does. trace:
// [trace] of config, perhaps without what the scene does not need.
std::string needs_rays(const Config& config, const TraceConfig& trace);

// Defined in table_checks.cpp: checks of arrays and several carriers, of vehicles and the time of their drive, of air
// and places, of materials, of edges beside tiles.
void check_arrays(const Config& config, std::vector<Contradiction>& out);
void check_trajectories(const Config& config, std::vector<Contradiction>& out);
void check_air(const Config& config, std::vector<Contradiction>& out);
void check_degrees(const Config& config, std::vector<Contradiction>& out);
void check_materials(const std::vector<MaterialConfig>& materials, std::vector<Contradiction>& out);
void check_scattering(const TraceConfig& trace, std::vector<Contradiction>& out);

// Defined in beam_checks.cpp: checks of frames that spare rays, of beams and of their floor.
void check_discoveries(const Config& config, std::vector<Contradiction>& out);
void check_beams(const Config& config, std::vector<Contradiction>& out);
void check_floor(const Config& config, std::vector<Contradiction>& out);

// Defined in target_checks.cpp.
void check_targets(const Config& config, std::vector<Contradiction>& out);
bool has_targets(const Config& config);  // also if trace.target is off

// Defined in trace_checks.cpp: keys of [trace] that ask for something which another key has not switched on.
void check_companions(const Config& config, std::vector<Contradiction>& out);

// Defined in radar_checks.cpp.
void check_radars(const Config& config, std::vector<Contradiction>& out);

// Defined in grid_checks.cpp.
void check_grids(const Config& config, std::vector<Contradiction>& out);

// Returns the grids of which each has one height: those of several heights become NAME@HEIGHT, one after the other.
std::vector<ReceiverGridConfig> one_of_each_height(const std::vector<ReceiverGridConfig>& grids);

}  // namespace wavetracer::config
