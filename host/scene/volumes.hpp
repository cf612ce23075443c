// Volumes of vegetation: those that the configuration lists, and closed meshes whose material is vegetation.
// Where volumes overlap, the space counts once (volume_overlaps.hpp).
#pragma once
#include <vector>

#include "scene/raw_scene.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// Adds [[vegetation]] to what a file has. Throws ConfigError for a size that is not positive.
void add_volumes(RawScene& raw, const std::vector<VegetationConfig>& vegetation);

// The parts of a mesh that hang together, each a volume of this material, in the coordinates of the mesh. Vertices
// within weld_tolerance_m are one, and so are triangles of the same corners, which the report counts. Throws InputError
// for a mesh that is not closed.
std::vector<Volume> mesh_volumes(const RawMesh& mesh, uint32_t material, LoadReport* report = nullptr);

}  // namespace wavetracer
