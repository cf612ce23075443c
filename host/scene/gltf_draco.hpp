// Meshes that are compressed by KHR_draco_mesh_compression, by Google's library.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace wavetracer {

class DracoMesh {
 public:
  // Throws std::invalid_argument with the library's words where the bytes are no mesh.
  explicit DracoMesh(std::string_view bytes);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  std::vector<std::array<uint32_t, 3>> triangles() const;
  // The numbers of the attribute with this id; empty where there is none of so many components.
  std::optional<std::vector<double>> numbers(uint32_t id, size_t components) const;

 private:
  struct Decoded;
  Decoded* decoded_;
};

}  // namespace wavetracer
