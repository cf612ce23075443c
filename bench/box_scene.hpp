// SPDX-License-Identifier: Apache-2.0
// Small scenes made of boxes and height fields, written as Wavefront OBJ.
// The same calls write the same bytes on every machine: coordinates are printed to a micrometre.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace wavetracer::bench {

class BoxScene {
 public:
  // Adds a closed box with its faces outwards.
  void box(const glm::dvec3& centre_m, const glm::dvec3& size_m);
  // Adds a surface of triangles over a square around the origin: cells x cells squares, each cut in two.
  void height_field(double side_m, uint32_t cells, const std::function<double(glm::dvec2)>& height_m);
  // Throws RuntimeError if the file cannot be written.
  void write(const std::filesystem::path& file) const;

 private:
  std::vector<glm::dvec3> vertices_;
  std::vector<std::array<uint32_t, 3>> triangles_;
};

}  // namespace wavetracer::bench
