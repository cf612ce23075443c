// SPDX-License-Identifier: Apache-2.0
// Compares paths with a reference list of tests/reference/oracle (its README.md says where they come from).
// Two paths match when ends and interactions agree, delays to 2e-6 (relative) or 30 ps, and every vertex to 30 cm:
// the lists are float32, whose points are up to 19 cm off at grazing angles.
#pragma once
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>
#include "wavetracer/paths.hpp"

namespace wavetracer::reference {

// One reference file. Surfaces, instances and Doppler shifts of the paths are unknown: they are 0.
struct Case {
  std::string name, scene;
  double frequency_hz = 0;
  uint32_t max_depth = 0;
  bool reflection = false, transmission = false, diffraction = false;
  std::vector<glm::dvec3> transmitters_m, receivers_m;  // file coordinates
  Paths paths;                                          // 2 x 2 ports, V and H; in the order of the file
};

// Throws InputError when the file is missing or not a reference list.
Case load_case(const std::filesystem::path& json_path);

// The agreement of paths, or of those of one kind, with the list.
struct Agreement {
  size_t reference = 0, found = 0, mine = 0;  // paths in the list, those matched, paths compared with it
  double recall = 0;                          // found / reference
  double power_recall = 0;                    // the same, each path weighted by its sum of |a|^2
  size_t extra = 0;                           // paths of ours that match none in the list
  double extra_power_ratio = 0;               // their power over the list's
  // For the matched paths; NaN if there are none (or none with the list's port counts, for gain and matrix).
  double delay_rel_err_max = 0;
  double gain_err_db_p50 = 0, gain_err_db_p99 = 0, gain_err_db_max = 0;
  double matrix_rel_err_p50 = 0, matrix_rel_err_p99 = 0;  // Frobenius norm of the difference over the list's
};

struct Comparison : Agreement {
  size_t duplicates = 0;  // ours that repeat another: delay to 1e-13 s, vertices to 1e-4 m
  // Agreement of the paths of both sides, by their interactions besides reflection: "specular" (none), "transmission",
  // "diffraction", "transmission + diffraction", ...
  std::map<std::string, Agreement> kinds;
  std::vector<size_t> missing;      // paths of the list that are not matched, as rows of Case::paths
  std::vector<size_t> extra_paths;  // our paths that are not matched
};

// paths: one frame, vertices in file coordinates. Each is matched once, the nearest first.
Comparison compare_paths(const std::filesystem::path& json_path, const Paths& paths);
Comparison compare_paths(const Case& reference, const Paths& paths);

// For test logs: a line about all paths, then one about each kind if there are several.
std::string to_string(const Comparison& comparison);
// A path in one line: ends, interactions, delay, gain and vertices.
std::string to_string(const Paths& paths, size_t i);

}  // namespace wavetracer::reference
