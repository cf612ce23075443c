// SPDX-License-Identifier: Apache-2.0
// A glTF 2.0 file in its binary form (.glb): arrays for its one buffer, and the JSON that says what they are.
// Assumes a little-endian machine, as the format is.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>
#include "wavetracer/scene.hpp"

namespace wavetracer {

class GlbFile {
 public:
  static_assert(std::endian::native == std::endian::little);
  using Colour = std::array<uint8_t, 4>;  // linear, not sRGB

  GlbFile();
  // Each function adds an accessor and returns its index. Arrays must not be empty.
  size_t add_positions(const std::vector<glm::vec3>& values);
  size_t add_colours(const std::vector<Colour>& values);
  size_t add_indices(const std::vector<uint32_t>& values);
  size_t add_times(const std::vector<float>& values);             // times of an animation's keyframes
  size_t add_translations(const std::vector<glm::vec3>& values);  // also used for scales
  size_t add_rotations(const std::vector<glm::vec4>& values);     // quaternions (x, y, z, w)

  // Appends to the array of that name ("nodes", "meshes", ...) and returns its index there.
  size_t add(const char* array, nlohmann::json element);
  nlohmann::json& root() { return json_; }

  // Throws RuntimeError, also where it would be longer than the 4 GiB that the format allows.
  void write(const std::filesystem::path& path);

 private:
  // target: 34962 (vertices), 34963 (indices) or 0 (neither).
  size_t add_accessor(std::span<const std::byte> bytes, size_t count, const char* type, int component, int target);
  template <class Values>
  void set_bounds(size_t accessor, const Values& values, size_t components);

  nlohmann::json json_;
  std::string buffer_;
};

// Returns a radio material as a material of glTF: its name, the colour that people expect, and its law in "extras", so
// that a custom law is not lost.
nlohmann::json glb_material(const Material& material);

}  // namespace wavetracer
