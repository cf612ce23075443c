// SPDX-License-Identifier: Apache-2.0
// OBJ and glTF models: meshes in the frame of the file's root, materials by name only. OBJ and glTF 1.0 are read by
// assimp, which keeps coordinates as float32: a warning says so where that costs over 1 mm.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "scene/raw_scene.hpp"

namespace wavetracer {

struct GltfFile;

enum class ModelFormat { obj, gltf };
// Chooses the format by the suffix: any suffix but .obj means glTF.
ModelFormat model_format(const std::filesystem::path& path);

// Ignores the suffix. Throws InputError that names the file and the mesh.
RawScene read_model(const std::filesystem::path& path, ModelFormat format);

// Defined in gltf.cpp: returns the triangles of the default scene of glTF 2.0. Throws InputError that names the file.
RawScene read_gltf(const GltfFile& file);

// Defined in obj_check.cpp: finds statements of an OBJ file that assimp ignores silently: unknown statements, curves,
// lines, points. Returns warnings, each with a count and the first line concerned. Throws InputError that names the
// line where triangles would be lost or moved: invalid numbers, statements that do not begin their line, and calls of
// other files.
std::vector<std::string> check_obj(const std::filesystem::path& path);

}  // namespace wavetracer
