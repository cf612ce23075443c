// SPDX-License-Identifier: Apache-2.0
// The files that a configuration names.
#pragma once
#include <string>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer::config {

struct NamedFile {
  std::string key;    // table and field, such as "scene.file"
  std::string* path;  // points into the configuration
};

// Returns files in the order of the field table, without values that are no files, such as "isotropic".
std::vector<NamedFile> input_files(Config& config);

}  // namespace wavetracer::config
