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

// A material as the file defines it. Without an ITU type and a permittivity only its name says what it is.
struct RawMaterial {
  std::string name;   // as in the file, prefixes kept
  std::string where;  // "file:line", for messages
  std::optional<std::string> itu_type;
  std::optional<double> permittivity, conductivity_s_m, thickness_m;
};

constexpr uint32_t no_material = 0xFFFFFFFFu;

struct RawMesh {
  std::string name;
  std::string where;  // the file that holds it, with the line where one is known
  std::vector<glm::dvec3> vertices;
  std::vector<Triangle> triangles;  // into vertices
  uint32_t material = no_material;  // into RawScene::materials
  // How far a coordinate may be off because the file, or its reader, holds it with few digits: half of their last step.
  double rounding = 0;
};

// The most that a coordinate, or the largest one of vertices, may lose in float32.
double float32_rounding(double coordinate);
double float32_rounding(std::span<const glm::dvec3> vertices);
// The most by which a transform makes lengths along an axis longer.
double largest_stretch(const glm::dmat4& transform);

// A volume of the configuration, in metres.
struct RawVolume {
  Volume volume;         // in the coordinates of the scene, without its material
  std::string material;  // its name
};

struct RawScene {
  std::string file;
  std::vector<std::string> files;  // that were read, in that order: this one, and those that it names
  std::vector<RawMesh> meshes;
  std::vector<RawMaterial> materials;
  std::vector<RawVolume> volumes;
  std::vector<SceneNode> nodes;
  std::vector<std::string> warnings;
  bool y_up = false;  // what the format prescribes; scene.up overrides it
};

}  // namespace wavetracer
