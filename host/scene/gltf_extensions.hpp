// The extensions of glTF that are read, and those that change nothing that a scene is made of.
#pragma once
#include <string>
#include <vector>

#include "scene/gltf_file.hpp"

namespace wavetracer {

// Throws InputError that names the extension where the file requires one that is not read (glTF 2.0, section 3.12).
// Returns warnings of those that it uses, does not require, and that are not known here.
std::vector<std::string> check_gltf_extensions(const GltfFile& file);

}  // namespace wavetracer
