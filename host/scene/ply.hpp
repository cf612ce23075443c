// SPDX-License-Identifier: Apache-2.0
// PLY meshes: a reader of every dialect (ascii, binary of either byte order, any property types), and a writer of one.
// Files are not trusted: counts are checked against the file's size before memory is allocated.
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
  uint64_t small_faces = 0;                // number of faces of fewer than three vertices, which are dropped
  std::vector<std::string> warnings = {};  // warnings about small faces and other content that is dropped
  double rounding = 0;                     // rounding of coordinates that are stored as float, see RawMesh
};

// Throws InputError that names the file and the element.
PlyMesh read_ply(const std::filesystem::path& path);

// Formats a mesh as binary little endian with float coordinates (the caller's coordinates must be exact in float) and
// uchar/int lists:
// the dialect that Mitsuba and Blender write.
std::string format_ply(std::span<const glm::dvec3> vertices, std::span<const Triangle> triangles);

}  // namespace wavetracer
