// SPDX-License-Identifier: Apache-2.0
// Small scene files for the tests of scene/: meshes as text.
// Assumes a writable folder for temporary files.
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "scene/load.hpp"
#include "temporary_folder.hpp"

namespace wavetracer::test {

// An ascii PLY file with the corners of a unit square on z = 0 (vertices) and these faces.
inline std::string square_ply(std::string_view faces, int face_count) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
         "element face " +
         std::to_string(face_count) +
         "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n" + std::string(faces);
}

// A closed box as ascii PLY of six quadrilaterals, with double coordinates written to the last bit.
inline std::string box_ply(glm::dvec3 low, glm::dvec3 high) {
  std::string out =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 8; ++i) {
    char line[128];
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", (i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y,
                  (i & 4) ? high.z : low.z);
    out += line;
  }
  return out + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
}

inline SceneConfig of_concrete() {
  SceneConfig config;
  config.default_material = "concrete";
  return config;
}

}  // namespace wavetracer::test
