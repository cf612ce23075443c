// Twenty scenes with antennas on which launches are measured: cities of many shapes, quarters of munich, street
// canyons, rooms, a car park, a bridge, a hill of houses. Nothing in the program was tuned on one of them alone.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer::bench {

// Their names, in the order in which they are measured.
std::vector<std::string> study_case_names();

// The same houses at the same places on flat ground and on hills of 10, 30 and 100 m: what a terrain costs, and whether
// launches find as much there. Measured where they are asked for.
std::vector<std::string> hill_case_names();

struct StudyCase {
  std::string name;
  Config config;  // standing ends, 5.9 GHz, the case's own depth
  // Where the transmitters may have come from, 9 m away and in sight of their places: for drives that end in `config`.
  std::vector<std::array<double, 3>> starts_m;
};

// shared: the folder of scenes/. folder: where meshes are written. seed: of the places; another one gives other places
// in the same scenes. Throws InputError where a scene of `shared` is missing.
StudyCase study_case(const std::string& name, const std::filesystem::path& shared, const std::filesystem::path& folder,
                     uint64_t seed);

// The same ends at the end of a drive of `frames` frames of 0.1 s, for which trace.reuse keeps sequences.
Config driving(const StudyCase& study_case, uint32_t frames);

}  // namespace wavetracer::bench
