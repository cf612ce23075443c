// PLY meshes: a reader of every dialect (ascii, binary of either byte order, any property types), a writer of one.
// Assumes nothing about a file: counts are checked against its size before memory is taken.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/raw_scene.hpp"

namespace wavetracer {

struct PlyMesh {
  std::vector<glm::dvec3> vertices;        // as stored: float coordinates become double unchanged
  std::vector<Triangle> triangles;         // polygons are triangulated
  uint64_t small_faces = 0;                // faces of fewer than three vertices, left out
  std::vector<std::string> warnings = {};  // of them, and of what else of the file is left out
  double rounding = 0;                     // of coordinates that are stored as float, see RawMesh
};

// Throws InputError that names the file and the element.
PlyMesh read_ply(const std::filesystem::path& path);

// Binary little endian, float coordinates (the caller's coordinates must survive that), uchar/int lists:
// the dialect that Mitsuba and Blender write.
std::string format_ply(std::span<const glm::dvec3> vertices, std::span<const Triangle> triangles);

}  // namespace wavetracer
