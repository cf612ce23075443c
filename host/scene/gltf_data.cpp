// SPDX-License-Identifier: Apache-2.0
// Numbers are little endian (glTF 2.0, section 3.6.2.1).
#include "scene/gltf_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "base/file.hpp"
#include "base/input_file.hpp"
#include "base/json_whole.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using nlohmann::json;

// Number of elements that an accessor without data may have, however short the file is.
constexpr uint64_t fewest_zeros = 4096;

enum ComponentType : int64_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

size_t bytes_of(int64_t type) {
  return type == i8 || type == u8 ? 1 : type == i16 || type == u16 ? 2 : type == u32 || type == f32 ? 4 : 0;
}

template <class T>
T little_endian(const char* bytes) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), bytes, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(own);
  return std::bit_cast<T>(own);
}

double number_at(const char* bytes, int64_t type) {
  switch (type) {
    case i8:
      return little_endian<int8_t>(bytes);
    case u8:
      return little_endian<uint8_t>(bytes);
    case i16:
      return little_endian<int16_t>(bytes);
    case u16:
      return little_endian<uint16_t>(bytes);
    case u32:
      return little_endian<uint32_t>(bytes);
    default:
      return static_cast<double>(little_endian<float>(bytes));
  }
}

// Returns the divisor of a normalised integer (section 3.11), and 1 for other types.
double largest_of(int64_t type) {
  return type == i8 ? 127 : type == u8 ? 255 : type == i16 ? 32767 : type == u16 ? 65535 : 1;
}

size_t components_of(const std::string& type) {
  constexpr std::pair<std::string_view, size_t> known[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                           {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, count] : known)
    if (name == type) return count;
  return 0;
}

// Returns the value of a base64 character, and 64 for all others.
uint32_t base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return static_cast<uint32_t>(c - 'A');
  if (c >= 'a' && c <= 'z') return static_cast<uint32_t>(c - 'a') + 26;
  if (c >= '0' && c <= '9') return static_cast<uint32_t>(c - '0') + 52;
  return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : 64;
}

std::string base64_bytes(std::string_view text) {
  std::string out;
  uint32_t bits = 0, held = 0;
  for (const char c : text) {
    const uint32_t digit = base64_digit(c);
    if (digit == 64) continue;  // it is padding or a line end
    bits = bits << 6 | digit;
    held += 6;
    if (held < 8) continue;
    held -= 8;
    out.push_back(static_cast<char>(bits >> held & 0xFFu));
  }
  return out;
}

// Decodes %20 and the like.
std::string percent_decoded(std::string_view text) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool coded = text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0;
    out.push_back(coded ? static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2])) : text[i]);
    if (coded) i += 2;
  }
  return out;
}

}  // namespace

struct GltfData::Elements {
  std::string_view bytes;
  size_t stride, step;  // bytes between elements, and between components
  int64_t type;

  double operator()(size_t element, size_t component) const {
    return number_at(bytes.data() + element * stride + component * step, type);
  }
};

GltfData::GltfData(const GltfFile& file) : file_(file) {}

void GltfData::fail(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", file_.path.string(), what));
}

const json& GltfData::item(const char* list, const json& index) const {
  const auto found = file_.document.find(list);
  if (found == file_.document.end() || !found->is_array() || !index.is_number_unsigned() ||
      index.get<uint64_t>() >= found->size())
    fail(fmt::format("it refers to {}[{}], which is not there", list, index.dump()));
  return (*found)[index.get<size_t>()];
}

std::string GltfData::read_uri(const std::string& uri) {
  if (uri.starts_with("data:")) {
    const size_t comma = uri.find(',');
    const std::string_view head = std::string_view(uri).substr(0, comma);
    if (comma == std::string::npos || !head.ends_with(";base64")) fail("a data URI is not in base64");
    return base64_bytes(std::string_view(uri).substr(comma + 1));
  }
  if (uri.find("://") != std::string::npos)
    fail(fmt::format("a buffer is at '{}': nothing is fetched; put the file beside this one", uri.substr(0, 200)));
  std::filesystem::path path = file_.path.parent_path() / percent_decoded(uri);
  std::error_code unnameable;
  // The name is not percent-encoded.
  if (!std::filesystem::exists(path, unnameable)) path = file_.path.parent_path() / uri;
  if (const std::string problem = input_file_problem(path, "the buffer"); !problem.empty())
    fail(fmt::format("the buffer {}: {}", path.string(), problem));
  files_.push_back(path.string());
  return read_file(path);
}

std::string GltfData::read_buffer(const json& buffer, size_t index) {
  if (const auto uri = buffer.find("uri"); uri != buffer.end()) return read_uri(uri->get<std::string>());
  if (index == 0 && file_.is_glb) return file_.binary;
  for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    if (buffer.contains("extensions") && buffer["extensions"].contains(name))
      fail(fmt::format("its meshes are compressed by {}, which is not read: export it without compression", name));
  fail(fmt::format("buffers[{}] has no uri, and no data in the file", index));
}

const std::string& GltfData::buffer(const json& index) {
  const json& found = item("buffers", index);
  const auto i = index.get<size_t>();
  auto at = buffers_.find(i);
  if (at == buffers_.end()) at = buffers_.emplace(i, read_buffer(found, i)).first;
  return at->second;
}

std::string_view GltfData::view(const json& index) {
  const json& found = item("bufferViews", index);
  const std::string& bytes = buffer(found.at("buffer"));
  const std::string name = fmt::format("bufferViews[{}]", index.dump());
  const auto first = whole_or<uint64_t>(found, "byteOffset", 0, name),
             length = whole_at<uint64_t>(found, "byteLength", name);
  if (first > bytes.size() || length > bytes.size() - first)
    fail(fmt::format("{} ends at byte {} of a buffer of {}: the file is incomplete or damaged", name, first + length,
                     bytes.size()));
  return std::string_view(bytes).substr(first, length);
}

GltfData::Elements GltfData::elements(const json& at, uint64_t count, size_t components, int64_t type) {
  const std::string_view bytes = view(at.at("bufferView"));
  const size_t step = bytes_of(type), size = step * components;
  if (size == 0) fail(fmt::format("an accessor has the componentType {}, which glTF does not know", type));
  const auto first = whole_or<uint64_t>(at, "byteOffset", 0, "an accessor");
  const auto stride = whole_or<uint64_t>(item("bufferViews", at.at("bufferView")), "byteStride", size,
                                         fmt::format("bufferViews[{}]", at.at("bufferView").dump()));
  if (stride < size || stride > 65536) fail(fmt::format("a byteStride of {} is not possible here", stride));
  if (count > 0 &&
      (first > bytes.size() || bytes.size() - first < size || count - 1 > (bytes.size() - first - size) / stride))
    fail(
        fmt::format("an accessor of {} elements ends behind its bufferViews[{}] of {} bytes: "
                    "the file is incomplete or damaged",
                    count, at.at("bufferView").dump(), bytes.size()));
  return {count > 0 ? bytes.substr(first) : std::string_view{}, stride, step, type};
}

void GltfData::put_sparse(const json& accessor, size_t components, std::vector<double>& out) {
  const json& sparse = accessor.at("sparse");
  const json &places = sparse.at("indices"), &values = sparse.at("values");
  const auto count = whole_at<uint64_t>(sparse, "count", "a sparse accessor");
  const auto place_type = whole_at<int64_t>(places, "componentType", "a sparse accessor"),
             value_type = whole_at<int64_t>(accessor, "componentType", "a sparse accessor");
  const Elements at = elements(places, count, 1, place_type);
  const Elements from = elements(values, count, components, value_type);
  for (size_t k = 0; k < count; ++k) {
    const double place = at(k, 0);
    if (!(place >= 0 && place < static_cast<double>(out.size() / components)))
      fail(fmt::format("a sparse accessor sets element {} of {}", place, out.size() / components));
    for (size_t c = 0; c < components; ++c) out[static_cast<size_t>(place) * components + c] = from(k, c);
  }
}

std::vector<double> GltfData::numbers(const json& index, size_t components) {
  const json& accessor = item("accessors", index);
  if (const auto type = accessor.at("type").get<std::string>(); components_of(type) != components)
    fail(
        fmt::format("accessors[{}] is of type {}, but one of {} components is needed", index.dump(), type, components));
  const std::string name = fmt::format("accessors[{}]", index.dump());
  const auto count = whole_at<uint64_t>(accessor, "count", name);
  const auto type = whole_at<int64_t>(accessor, "componentType", name);
  std::vector<double> out;
  if (accessor.contains("bufferView")) {
    const Elements from = elements(accessor, count, components, type);
    out.reserve(count * components);
    for (size_t k = 0; k < count; ++k)
      for (size_t c = 0; c < components; ++c) out.push_back(from(k, c));
  } else {
    uint64_t bytes = file_.binary.size();
    for (const auto& [number, buffer] : buffers_) bytes += buffer.size();
    if (count > std::max(fewest_zeros, bytes))
      fail(fmt::format("accessors[{}] has {} elements and no bufferView", index.dump(), count));
    out.resize(count * components);
  }
  if (accessor.contains("sparse")) put_sparse(accessor, components, out);
  if (accessor.value("normalized", false) && largest_of(type) > 1)
    for (double& x : out) x = std::max(x / largest_of(type), -1.0);
  return out;
}

}  // namespace wavetracer
