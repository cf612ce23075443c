// SPDX-License-Identifier: Apache-2.0
// Writes the XML of a .vtp file, and its body.
// Sizes must be below 2^63 bytes.
#include "convert/vtk_file.hpp"
#include <fmt/format.h>
#include <bit>

namespace wavetracer {

void VtkFile::add(Section section, const char* name, const char* type, size_t components, size_t tuples,
                  std::span<const std::byte> bytes) {
  const std::string count = section == field_data ? fmt::format(" NumberOfTuples=\"{}\"", tuples) : "";
  arrays_[section] += fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type,
      name, components, count, body_.size());
  const uint64_t size = bytes.size();
  body_.append(reinterpret_cast<const char*>(&size), sizeof size);
  body_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

// Texts are stored one after the other, each ended by a zero byte.
void VtkFile::add(Section section, const char* name, const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts) joined.append(text.c_str()).push_back('\0');
  add(section, name, "String", 1, texts.size(), std::as_bytes(std::span(joined)));
}

void VtkFile::add_points(const std::vector<glm::dvec3>& positions_m) {
  add(points, "Points", positions_m);
  point_count_ = positions_m.size();
}

void VtkFile::add_cells(Section section, const std::vector<int64_t>& connectivity, const std::vector<int64_t>& ends) {
  add(section, "connectivity", connectivity);
  add(section, "offsets", ends);
  cell_count_[section] = ends.size();
}

std::string VtkFile::head() const {
  const auto element = [this](const char* name, Section section) {
    return arrays_[section].empty() ? "" : fmt::format("<{0}>\n{1}</{0}>\n", name, arrays_[section]);
  };
  return fmt::format(
             "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n<PolyData>\n",
             std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian") +
         element("FieldData", field_data) +
         fmt::format(
             "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
             "NumberOfPolys=\"{}\">\n",
             point_count_, cell_count_[verts], cell_count_[lines], cell_count_[polys]) +
         element("PointData", point_data) + element("CellData", cell_data) + element("Points", points) +
         element("Verts", verts) + element("Lines", lines) + element("Polys", polys) +
         "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
}

}  // namespace wavetracer
