// SPDX-License-Identifier: Apache-2.0
// Primitives of glTF 2.0 meshes as triangles: modes, indices, morph targets, skins and KHR_draco_mesh_compression.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "scene/gltf_data.hpp"
#include "scene/raw_scene.hpp"

namespace wavetracer {

// The transforms that place the vertices of a node: its own, or those of the joints of its skin.
struct GltfPlace {
  glm::dmat4 world{1};
  std::vector<glm::dmat4> joints = {};  // world matrix times inverse bind matrix, one per joint; empty without a skin
  std::vector<double> morph_weights = {};  // weights of the node; if empty, those of the mesh apply

  // Returns the largest factor by which the transforms stretch a length.
  double largest_stretch() const;
};

class GltfMeshes {
 public:
  GltfMeshes(const GltfFile& file, GltfData& data) : file_(file), data_(data) {}

  // Returns the primitives of the mesh that are surfaces, with material indices of the file.
  std::vector<RawMesh> read(const nlohmann::json& mesh, const GltfPlace& place);
  // Returns the number of primitives skipped so far: points, lines, and those without positions.
  uint64_t not_surfaces() const { return not_surfaces_; }
  // Returns the largest coordinate of positions so far, in the file's units.
  double largest_coordinate() const { return largest_; }

 private:
  struct Primitive;

  bool read_primitive(const nlohmann::json& from, Primitive& to);
  void read_draco(const nlohmann::json& from, const nlohmann::json& extension, Primitive& to);
  void read_indices(const nlohmann::json& from, int64_t mode, Primitive& to);
  void morph(const nlohmann::json& from, const std::vector<double>& weights, Primitive& to);
  void place(const nlohmann::json& from, const GltfPlace& by, Primitive& to);
  std::vector<double> attribute(const nlohmann::json& from, const char* name, size_t components, const Primitive& of);

  const GltfFile& file_;
  GltfData& data_;
  uint64_t not_surfaces_ = 0;
  double largest_ = 0;
};

}  // namespace wavetracer
