// SPDX-License-Identifier: Apache-2.0
// The glTF extensions that are read, and those that change nothing in a scene.
#pragma once
#include <string>
#include <vector>

#include "scene/gltf_file.hpp"

namespace wavetracer {

// Throws InputError that names the extension if the file requires one that is not read (glTF 2.0, section 3.12).
// Returns warnings about extensions that the file uses without requiring them and that are unknown here.
std::vector<std::string> check_gltf_extensions(const GltfFile& file);

}  // namespace wavetracer
