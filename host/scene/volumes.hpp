// SPDX-License-Identifier: Apache-2.0
// Volumes of vegetation: those of the configuration, and closed meshes whose material is vegetation. Where volumes
// overlap, the space counts once (volume_overlaps.hpp).
#pragma once
#include <vector>

#include "scene/raw_scene.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Adds [[vegetation]] to the volumes of a file. Throws ConfigError for a size that is not positive.
void add_volumes(RawScene& raw, const std::vector<VegetationConfig>& vegetation);

// Splits a mesh into connected parts, each a volume of this material, in the coordinates of the mesh. Vertices within
// weld_tolerance_m are merged, and so are triangles of the same corners, which the report counts. Throws InputError if
// the mesh is not closed.
std::vector<Volume> mesh_volumes(const RawMesh& mesh, uint32_t material, LoadReport* report = nullptr);

}  // namespace wavetracer
