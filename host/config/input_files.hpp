// The files that a configuration names.
#pragma once
#include <string>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer::config {

struct NamedFile {
  std::string key;    // table and field: "scene.file"
  std::string* path;  // in the configuration
};

// In the order of the field table; values that are no files, such as "isotropic", are left out.
std::vector<NamedFile> input_files(Config& config);

}  // namespace wavetracer::config
