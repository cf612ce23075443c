// The JSON and the binary data of a glTF file, with what must be checked before memory is taken for its content.
// Assumes nothing of the file.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace wavetracer {

struct GltfFile {
  std::filesystem::path path;
  nlohmann::json document;  // an object
  std::string binary;       // of a GLB file: the chunk after the JSON
  bool is_glb = false;
};

// Throws InputError where a chunk of a GLB file is longer than the file, where the JSON cannot be read or nests deeply,
// where nodes do, and where a node has two parents (glTF 2.0, section 3.5.2): thirty that name each other twice would
// become 10^9.
GltfFile read_gltf_file(const std::filesystem::path& path);

}  // namespace wavetracer
