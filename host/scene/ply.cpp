// The body of a PLY file, as its header describes it.
// Assumes IEEE 754 numbers on a little or big endian host; every access to the file is bounds checked.
#include "scene/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/file.hpp"
#include "scene/ply_header.hpp"
#include "scene/polygon.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using ply::Element, ply::Format, ply::Header, ply::Property, ply::Type;

// The values after the header, in file order.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, Format format, const std::string& file)
      : next_(bytes.data()), end_(bytes.data() + bytes.size()), format_(format), file_(file) {}

  // Starts an element; refuses counts that the rest of the file cannot hold.
  void begin(const Element& element) {
    element_ = &element;
    index_ = 0;
    uint64_t least = 0;  // bytes of one entry; a number in ascii needs a digit and a separator
    for (const Property& p : element.properties) {
      least += format_ == Format::ascii ? 2 : ply::size_of(p.count ? *p.count : p.type);
    }
    const uint64_t left = static_cast<uint64_t>(end_ - next_) + 1;  // the last separator of an ascii file may be absent
    if (least > 0 && element.count > left / least) {
      throw InputError(
          fmt::format("{}: the header declares {} entries of element '{}', at least {} bytes each, but only {} bytes "
                      "are left: the file is incomplete or its header is wrong",
                      file_, element.count, element.name, least, left - 1));
    }
  }
  void at(uint64_t index) { index_ = index; }

  double scalar(Type type) {
    if (format_ == Format::ascii) return word(type);
    switch (type) {
      case Type::i8:
        return raw<int8_t>();
      case Type::u8:
        return raw<uint8_t>();
      case Type::i16:
        return raw<int16_t>();
      case Type::u16:
        return raw<uint16_t>();
      case Type::i32:
        return raw<int32_t>();
      case Type::u32:
        return raw<uint32_t>();
      case Type::f32:
        return static_cast<double>(raw<float>());
      case Type::f64:
        break;
    }
    return raw<double>();
  }

  // The length of a list, checked against what is left of the file.
  size_t length(const Property& property) {
    const double n = scalar(*property.count);
    const size_t bytes = format_ == Format::ascii ? 1 : ply::size_of(property.type);
    if (!(n >= 0) || n * static_cast<double>(bytes) > static_cast<double>(end_ - next_)) {
      fail(fmt::format("property '{}' has the length {}, which is more than the file contains", property.name, n));
    }
    return static_cast<size_t>(n);
  }

  void skip(const Property& property) {
    size_t n = property.count ? length(property) : 1;
    while (n-- > 0) scalar(property.type);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {} {} of {}: {}", file_, element_->name, index_, element_->count, what));
  }

 private:
  template <class T>
  T raw() {
    if (static_cast<size_t>(end_ - next_) < sizeof(T)) fail("the file ends here: it is incomplete");
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), next_, sizeof(T));
    next_ += sizeof(T);
    const bool host_little = std::endian::native == std::endian::little;
    if ((format_ == Format::little) != host_little) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

  double word(Type type) {
    while (next_ < end_ && ply::is_space(*next_)) ++next_;
    if (next_ == end_) fail("the file ends here: it is incomplete");
    const char* begin = next_;
    while (next_ < end_ && !ply::is_space(*next_)) ++next_;
    const std::string_view text(begin, static_cast<size_t>(next_ - begin));
    if (*begin == '+') ++begin;
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, next_, value);
    const bool whole = type >= Type::f32 || value == std::floor(value);
    if (error != std::errc() || stop != next_ || !whole) {
      fail(fmt::format("'{}' is not a{} number", text, type >= Type::f32 ? "" : " whole"));
    }
    return value;
  }

  const char* next_;
  const char* end_;
  Format format_;
  const std::string& file_;
  const Element* element_ = nullptr;
  uint64_t index_ = 0;
};

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
  std::vector<uint32_t> corners;  // of all polygons, one after the other
  std::vector<size_t> first{0};
};

// Corners are checked later: an element 'face' may come before 'vertex'.
Faces read_faces(PlyBody& body, const Element& element, const std::string& file) {
  size_t list = element.properties.size();
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const Property& p = element.properties[i];
    if (p.count && (p.name == "vertex_indices" || p.name == "vertex_index")) list = i;
  }
  if (list == element.properties.size() || element.properties[list].type >= Type::f32) {
    throw InputError(
        fmt::format("{}: element 'face' needs a list of integers 'vertex_indices' (or 'vertex_index')", file));
  }
  Faces faces;
  for (uint64_t f = 0; f < element.count; ++f) {
    body.at(f);
    for (size_t i = 0; i < element.properties.size(); ++i) {
      const Property& p = element.properties[i];
      if (i != list) {
        body.skip(p);
        continue;
      }
      for (size_t n = body.length(p); n > 0; --n) {
        const double index = body.scalar(p.type);
        if (index < 0 || index > std::numeric_limits<uint32_t>::max()) {
          body.fail(fmt::format("vertex index {} is out of range", index));
        }
        faces.corners.push_back(static_cast<uint32_t>(index));
      }
    }
    faces.first.push_back(faces.corners.size());
  }
  return faces;
}

}  // namespace

PlyMesh read_ply(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string content = read_file(path);
  const Header header = ply::parse_header(content, file);
  PlyBody body(std::string_view(content).substr(header.size), header.format, file);
  PlyMesh mesh;
  std::optional<Faces> faces;
  bool has_vertices = false;
  for (const Element& element : header.elements) {
    body.begin(element);
    if (element.name == "vertex" && !has_vertices) {
      has_vertices = true;
      read_vertices(body, element, file, mesh.vertices);
    } else if (element.name == "face" && !faces) {
      faces = read_faces(body, element, file);
    } else if (!element.properties.empty()) {
      for (uint64_t i = 0; i < element.count; ++i) {
        body.at(i);
        for (const Property& p : element.properties) body.skip(p);
      }
    }
  }
  if (!has_vertices) throw InputError(fmt::format("{}: the PLY file has no element 'vertex'", file));
  if (!faces)
    throw InputError(fmt::format("{}: the PLY file has no element 'face': a point cloud is not a mesh", file));
  const size_t face_count = faces->first.size() - 1;
  for (size_t f = 0; f < face_count; ++f) {
    const std::span<const uint32_t> polygon(faces->corners.data() + faces->first[f],
                                            faces->first[f + 1] - faces->first[f]);
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
