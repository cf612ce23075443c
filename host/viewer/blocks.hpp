// SPDX-License-Identifier: Apache-2.0
// Binary data on a page: little-endian arrays in base64, which the page's data.js reads by name.
// Values that 16 bits cannot hold are clamped; NaN becomes 0.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace wavetracer {

static_assert(std::endian::native == std::endian::little, "pages hold little-endian arrays");

// The bytes of values one after the other.
class Packer {
 public:
  template <class T>
  void add(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void add(const glm::dvec3& p) {
    for (int axis = 0; axis < 3; ++axis) add(static_cast<float>(p[axis]));
  }
  // Adds a value in -limit..limit as a multiple of limit / 32767.
  void add_share(double value, double limit) {
    const double share = std::isfinite(value) ? std::clamp(value / limit, -1.0, 1.0) : 0.0;
    add(static_cast<int16_t>(std::lround(32767 * share)));
  }
  void append(const Packer& other) { bytes_ += other.bytes_; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string base64(std::string_view bytes);

// Returns an element that a browser neither shows nor runs. name: letters, digits and _.
std::string block_element(const std::string& name, const Packer& data);

// Returns JSON text for a script element: ASCII, without a character that could end the element.
std::string script_text(std::string json);

}  // namespace wavetracer
