// SPDX-License-Identifier: Apache-2.0
// OBJ and glTF models: meshes in the frame of the file's root, materials by name only. OBJ and glTF 1.0 are read by
// assimp, which keeps coordinates as float32: a warning says so where that costs over 1 mm.
#pragma once
#include <filesystem>

#include "scene/raw_scene.hpp"

namespace wavetracer {

enum class ModelFormat { obj, gltf };
// Chooses the format by the suffix: any suffix but .obj means glTF.
ModelFormat model_format(const std::filesystem::path& path);

// Ignores the suffix. Throws InputError that names the file and the mesh.
RawScene read_model(const std::filesystem::path& path, ModelFormat format);

}  // namespace wavetracer
