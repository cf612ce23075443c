// SPDX-License-Identifier: Apache-2.0
// Twenty scenes with antennas on which launches are measured: cities of many shapes, quarters of munich, street
// canyons, rooms, a car park, a bridge, a hill of houses. The program was not tuned on any single one of them.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer::bench {

// Returns their names, in the order in which they are measured.
std::vector<std::string> study_case_names();

// Returns cases that are measured only if asked for. Hills have the same houses at the same places on flat ground and
// on hills of 10, 30 and 100 m: they show the cost of a terrain, and whether launches find as much there. Plains have a
// town on a plain of 100 km and an antenna 1 to 40 km away in the sky: few rays meet the town, and no window helps.
std::vector<std::string> further_case_names();

struct StudyCase {
  std::string name;
  Config config;  // fixed ends, 5.9 GHz, the case's own depth
  // Starts of the transmitters' drives, 9 m from their places with a clear line to them: for drives that end in
  // `config`.
  std::vector<std::array<double, 3>> starts_m;
};

// shared: the folder of scenes/. folder: where meshes are written. seed: of the places; another seed gives other places
// in the same scenes. Throws InputError if a scene of `shared` is missing.
StudyCase study_case(const std::string& name, const std::filesystem::path& shared, const std::filesystem::path& folder,
                     uint64_t seed);

// Returns the same ends at the end of a drive of `frames` frames of 0.1 s, for which trace.reuse keeps sequences.
Config driving(const StudyCase& study_case, uint32_t frames);

}  // namespace wavetracer::bench
