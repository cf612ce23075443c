// SPDX-License-Identifier: Apache-2.0
// A file of VTK's XML PolyData (.vtp): points with vertices, lines or triangles, and arrays on them.
// Arrays follow the XML in binary form (appended, raw), each after its size as UInt64.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace wavetracer {

class VtkFile {
 public:
  enum Section : size_t { field_data, point_data, cell_data, points, verts, lines, polys };

  // values: rows with this number of components. Names must not need escapes in XML.
  template <class T>
  void add(Section section, const char* name, const std::vector<T>& values, size_t components = 1) {
    add(section, name, type_name<T>(), components, values.size() / components, std::as_bytes(std::span(values)));
  }
  void add(Section section, const char* name, const std::vector<glm::dvec3>& values) {
    add(section, name, "Float64", 3, values.size(), std::as_bytes(std::span(values)));
  }
  void add(Section section, const char* name, const std::vector<std::string>& texts);
  void add_points(const std::vector<glm::dvec3>& positions_m);
  // Adds cells to one section: cell i has the points connectivity[ends[i - 1]] to connectivity[ends[i] - 1].
  void add_cells(Section section, const std::vector<int64_t>& connectivity, const std::vector<int64_t>& ends);

  // The file is head(), body() and tail(), one after the other.
  std::string head() const;
  std::string_view body() const { return body_; }
  static std::string_view tail() { return "\n</AppendedData>\n</VTKFile>\n"; }

 private:
  template <class T>
  static consteval const char* type_name() {  // does not compile for other types: nothing is returned
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, int32_t>) return "Int32";
    if constexpr (std::is_same_v<T, uint32_t>) return "UInt32";
    if constexpr (std::is_same_v<T, uint8_t>) return "UInt8";
  }
  void add(Section section, const char* name, const char* type, size_t components, size_t tuples,
           std::span<const std::byte> bytes);

  std::array<std::string, 7> arrays_;  // the <DataArray> elements of each section
  std::string body_;
  size_t point_count_ = 0;
  std::array<size_t, 7> cell_count_{};  // numbers of verts, lines and polys
};

}  // namespace wavetracer
