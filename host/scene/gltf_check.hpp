// Checks of a glTF file that assimp does not make before it allocates memory.
// Assumes nothing of the file.
#pragma once
#include <filesystem>

namespace wavetracer {

// Throws InputError where a chunk of a GLB file is longer than the file, where the JSON cannot be read or nests deeply,
// where nodes do, and where a node has two parents (glTF 2.0, section 3.5.2): thirty that name each other twice would
// become 10^9.
void check_gltf(const std::filesystem::path& path);

}  // namespace wavetracer
