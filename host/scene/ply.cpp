// SPDX-License-Identifier: Apache-2.0
// The mesh in the body of a PLY file, as its header describes it.
#include "scene/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "base/file.hpp"
#include "scene/ply_file.hpp"
#include "scene/polygon.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using ply::Element, ply::Header, ply::PlyBody, ply::Property, ply::Type;

void read_vertices(PlyBody& body, const Element& element, const std::string& file, std::vector<glm::dvec3>& vertices) {
  std::vector<int> axis(element.properties.size(), -1);  // property -> coordinate
  int found = 0;
  for (size_t i = 0; i < axis.size(); ++i) {
    const Property& p = element.properties[i];
    if (!p.count && p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z') {
      axis[i] = p.name[0] - 'x';
      found |= 1 << axis[i];
    }
  }
  if (found != 7) throw InputError(fmt::format("{}: element 'vertex' needs the properties x, y and z", file));
  vertices.reserve(element.count);
  for (uint64_t v = 0; v < element.count; ++v) {
    body.at(v);
    glm::dvec3 position(0);
    for (size_t i = 0; i < axis.size(); ++i) {
      if (axis[i] < 0) {
        body.skip(element.properties[i]);
        continue;
      }
      const double value = body.scalar(element.properties[i].type);
      if (!std::isfinite(value))
        body.fail(fmt::format("{} is {}, not a finite number", element.properties[i].name, value));
      position[axis[i]] = value;
    }
    vertices.push_back(position);
  }
}

struct Faces {
  std::vector<uint32_t> corners;  // corners of all polygons, one after the other
  std::vector<size_t> first{0};
};

// Returns the index of the property that lists the corners of faces or strips; Turk's files call it vertex_indices,
// others vertex_index.
size_t corner_list(const Element& element, const std::string& file) {
  const size_t none = element.properties.size();
  size_t list = none;
  for (size_t i = 0; i < none; ++i) {
    const Property& p = element.properties[i];
    if (!p.count || (p.name != "vertex_indices" && p.name != "vertex_index")) continue;
    if (list != none)
      throw InputError(
          fmt::format("{}: element '{}' has two lists of vertices; keep 'vertex_indices'", file, element.name));
    list = i;
  }
  if (list == none || element.properties[list].type >= Type::f32) {
    throw InputError(fmt::format("{}: element '{}' needs a list of integers 'vertex_indices' (or 'vertex_index')", file,
                                 element.name));
  }
  return list;
}

// Calls take(index) for every number of the lists of vertices, and end(entry) after each list.
template <class Take, class End>
void read_lists(PlyBody& body, const Element& element, const std::string& file, const Take& take, const End& end) {
  const size_t list = corner_list(element, file);
  for (uint64_t entry = 0; entry < element.count; ++entry) {
    body.at(entry);
    for (size_t i = 0; i < element.properties.size(); ++i) {
      const Property& p = element.properties[i];
      if (i != list) {
        body.skip(p);
        continue;
      }
      for (size_t n = body.length(p); n > 0; --n) take(body.scalar(p.type));
    }
    end();
  }
}

uint32_t corner_of(const PlyBody& body, double index) {
  if (!(index >= 0) || index > std::numeric_limits<uint32_t>::max())
    body.fail(fmt::format("vertex index {} is out of range", index));
  return static_cast<uint32_t>(index);
}

// Corners are checked later: an element 'face' may come before 'vertex'.
void read_faces(PlyBody& body, const Element& element, const std::string& file, Faces& faces) {
  read_lists(
      body, element, file, [&](double index) { faces.corners.push_back(corner_of(body, index)); },
      [&] { faces.first.push_back(faces.corners.size()); });
}

// Reads triangle strips; -1 ends a strip. Every corner after the second makes a triangle with the two before it, and
// every other triangle is turned. A triangle that has a corner twice only joins strips and is dropped.
void read_strips(PlyBody& body, const Element& element, const std::string& file, Faces& faces) {
  std::vector<uint32_t> strip;
  read_lists(
      body, element, file,
      [&](double index) {
        if (index == -1) {
          strip.clear();
          return;
        }
        strip.push_back(corner_of(body, index));
        const size_t n = strip.size();
        if (n < 3 || strip[n - 1] == strip[n - 2] || strip[n - 2] == strip[n - 3] || strip[n - 1] == strip[n - 3])
          return;
        const bool turned = n % 2 == 0;
        faces.corners.insert(faces.corners.end(),
                             {strip[n - 3], strip[turned ? n - 1 : n - 2], strip[turned ? n - 2 : n - 1]});
        faces.first.push_back(faces.corners.size());
      },
      [&] { strip.clear(); });
}

// Reads the elements of the body that make a mesh; for the others a warning says what is lost.
struct Elements {
  const std::string& file;
  PlyMesh& mesh;
  bool has_vertices = false, has_faces = false, has_strips = false;
  Faces faces = {};

  void once(bool& seen, const Element& element) const {
    if (seen) throw InputError(fmt::format("{}: the header has the element '{}' twice", file, element.name));
    seen = true;
  }

  void read(PlyBody& body, const Element& element) {
    body.begin(element);
    if (element.name == "vertex") {
      once(has_vertices, element);
      read_vertices(body, element, file, mesh.vertices);
      if (std::ranges::any_of(element.properties,
                              [](const Property& p) { return p.name == "x" && p.type == Type::f32; }))
        mesh.rounding = float32_rounding(mesh.vertices);
    } else if (element.name == "face") {
      once(has_faces, element);
      read_faces(body, element, file, faces);
    } else if (element.name == "tristrips") {
      once(has_strips, element);
      read_strips(body, element, file, faces);
    } else {
      skip(body, element);
    }
  }

  void skip(PlyBody& body, const Element& element) const {
    // Edges are those of faces, or wires; the others say how a picture of the mesh is made.
    constexpr std::array<std::string_view, 6> harmless = {"edge", "material", "camera",
                                                          "user", "texture",  "range_grid"};
    if (!element.properties.empty()) {
      for (uint64_t i = 0; i < element.count; ++i) {
        body.at(i);
        for (const Property& p : element.properties) body.skip(p);
      }
    }
    if (element.count > 0 && std::ranges::find(harmless, element.name) == harmless.end())
      mesh.warnings.push_back(
          fmt::format("{}: {} entries of the element '{}' were left out: only vertex, "
                      "face and tristrips make surfaces",
                      file, element.count, element.name));
  }
};

void add_triangles(const Faces& faces, const std::string& file, PlyMesh& mesh) {
  const size_t face_count = faces.first.size() - 1;
  for (size_t f = 0; f < face_count; ++f) {
    const std::span<const uint32_t> polygon(faces.corners.data() + faces.first[f], faces.first[f + 1] - faces.first[f]);
    for (uint32_t v : polygon) {
      if (v >= mesh.vertices.size()) {
        throw InputError(fmt::format("{}: face {} of {}: vertex index {} is out of range, the file has {} vertices",
                                     file, f, face_count, v, mesh.vertices.size()));
      }
    }
    if (polygon.size() < 3) {
      ++mesh.small_faces;
    } else {
      triangulate_polygon(mesh.vertices, polygon, mesh.triangles);
    }
  }
}

}  // namespace

PlyMesh read_ply(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string whole = read_file(path);
  std::string_view content = whole;
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);  // a byte order mark
  const Header header = ply::parse_header(content, file);
  PlyBody body(content.substr(header.size), header.format, file);
  PlyMesh mesh;
  Elements elements{file, mesh};
  for (const Element& element : header.elements) elements.read(body, element);
  if (!elements.has_vertices) throw InputError(fmt::format("{}: the PLY file has no element 'vertex'", file));
  if (!elements.has_faces && !elements.has_strips)
    throw InputError(fmt::format("{}: the PLY file has no element 'face': a point cloud is not a mesh", file));
  add_triangles(elements.faces, file, mesh);
  if (mesh.small_faces > 0)
    mesh.warnings.push_back(
        fmt::format("{}: {} faces of fewer than three vertices were left out", file, mesh.small_faces));
  if (const size_t left = body.left(); left > 0)
    mesh.warnings.push_back(fmt::format(
        "{}: {} bytes follow what the header declares, and were left out: are its counts right?", file, left));
  return mesh;
}

std::string format_ply(std::span<const glm::dvec3> vertices, std::span<const Triangle> triangles) {
  std::string out = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      vertices.size(), triangles.size());
  const auto put = [&out](uint32_t bits) {
    for (unsigned shift = 0; shift < 32; shift += 8) out.push_back(static_cast<char>((bits >> shift) & 0xFFu));
  };
  for (const glm::dvec3& v : vertices) {
    for (int k = 0; k < 3; ++k) put(std::bit_cast<uint32_t>(static_cast<float>(v[k])));
  }
  for (const Triangle& t : triangles) {
    out.push_back(3);
    for (uint32_t v : t) put(v);
  }
  return out;
}

}  // namespace wavetracer
