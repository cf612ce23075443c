// SPDX-License-Identifier: Apache-2.0
// Decodes meshes that KHR_draco_mesh_compression compressed, with Google's library.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace wavetracer {

class DracoMesh {
 public:
  // Throws std::invalid_argument with the library's message if the bytes are no mesh.
  explicit DracoMesh(std::string_view bytes);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  std::vector<std::array<uint32_t, 3>> triangles() const;
  // Returns the numbers of the attribute with this id; nothing if there is none with this number of components.
  std::optional<std::vector<double>> numbers(uint32_t id, size_t components) const;

 private:
  struct Decoded;
  Decoded* decoded_;
};

}  // namespace wavetracer
