// SPDX-License-Identifier: Apache-2.0
// The JSON and the binary data of a glTF file, with the checks that are needed before memory is allocated for its
// content, and of its extensions: which ones are read, and which ones change nothing in a scene. The file is not
// trusted.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace wavetracer {

struct GltfFile {
  std::filesystem::path path;
  nlohmann::json document;  // an object
  std::string binary;       // the chunk after the JSON of a GLB file
  bool is_glb = false;
};

// Throws InputError if a chunk of a GLB file is longer than the file, if the JSON cannot be read or is nested deeply,
// if nodes are nested deeply, or if a node has two parents (glTF 2.0, section 3.5.2): thirty nodes that name each other
// twice would expand to 10^9.
GltfFile read_gltf_file(const std::filesystem::path& path);

// Throws InputError that names the extension if the file requires one that is not read (glTF 2.0, section 3.12).
// Returns warnings about extensions that the file uses without requiring them and that are unknown here.
std::vector<std::string> check_gltf_extensions(const GltfFile& file);

}  // namespace wavetracer
