// SPDX-License-Identifier: Apache-2.0
// The result of a reader: meshes and material definitions as they are in the file, not yet welded or resolved.
// Coordinates are double, in file units and file axes; indices are valid and coordinates finite once a reader returns.
#pragma once
#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

using Triangle = std::array<uint32_t, 3>;

// A material as the file defines it. Without an ITU type and a permittivity, only its name says what it is.
struct RawMaterial {
  std::string name;   // as in the file, prefixes kept
  std::string where;  // "file:line", for messages
  std::optional<std::string> itu_type;
  std::optional<double> permittivity, conductivity_s_m, thickness_m;
};

constexpr uint32_t no_material = 0xFFFFFFFFu;

struct RawMesh {
  std::string name;
  std::string where;  // file that holds it, with the line if known
  std::vector<glm::dvec3> vertices;
  std::vector<Triangle> triangles;  // into vertices
  uint32_t material = no_material;  // into RawScene::materials
  // The largest error of a coordinate because the file, or its reader, stores few digits: half of the last digit's
  // step.
  double rounding = 0;
};

// Returns the largest error that float32 storage causes in a coordinate, or in the largest one of vertices.
double float32_rounding(double coordinate);
double float32_rounding(std::span<const glm::dvec3> vertices);
// Returns the largest factor by which a transform stretches a length.
double largest_stretch(const glm::dmat4& transform);

// A volume of the configuration, in metres.
struct RawVolume {
  Volume volume;         // in the coordinates of the scene; its material is not set
  std::string material;  // name of its material
};

struct RawScene {
  std::string file;
  std::vector<std::string> files;  // files that were read, in that order: the scene file, then those that it names
  std::vector<RawMesh> meshes;
  std::vector<RawMaterial> materials;
  std::vector<RawVolume> volumes;
  std::vector<SceneNode> nodes;
  std::vector<std::string> warnings;
  bool y_up = false;  // the format's rule; scene.up overrides it
};

}  // namespace wavetracer
