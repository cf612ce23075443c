// SPDX-License-Identifier: Apache-2.0
// glTF 2.0: the triangles of its default scene, in the frame of the file, materials by name only.
#pragma once
#include "scene/gltf_file.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer {

// Throws InputError that names the file.
RawScene read_gltf(const GltfFile& file);

}  // namespace wavetracer
