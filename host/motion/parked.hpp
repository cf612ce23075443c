// SPDX-License-Identifier: Apache-2.0
// Reads places of parked vehicles: CSV with a header that names the columns, in any order: x, y (m) are needed; z (m),
// yaw (degrees counter-clockwise from +x) and type are optional, and their cells may be empty. Plain or gzip.
#pragma once
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace wavetracer {

struct ParkedPlace {
  glm::dvec3 position_m{0};  // centre of the footprint, on the ground
  double yaw_deg = 0;
  std::string type;  // empty if not given
};

// Returns the places in the order of the file, at least one. Throws InputError.
std::vector<ParkedPlace> read_parked(const std::filesystem::path& path);

}  // namespace wavetracer
