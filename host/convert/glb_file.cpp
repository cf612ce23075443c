// SPDX-License-Identifier: Apache-2.0
// The layout of .glb: a header of 12 bytes, then chunks of JSON and of the buffer, each padded to 4 bytes. In names,
// bytes that are not UTF-8 become U+FFFD.
#include "convert/glb_file.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include "base/pending_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using nlohmann::json;

constexpr int unsigned_byte = 5121, unsigned_int = 5125, floating = 5126;
constexpr int array_buffer = 34962, element_array_buffer = 34963;

// Returns a linear colour, as glTF has them; vegetation is translucent.
json base_colour(const Material& material) {
  static constexpr struct {
    const char* name;
    std::array<double, 3> colour;
  } known[] = {{"brick", {0.35, 0.11, 0.07}},          {"glass", {0.25, 0.45, 0.55}},
               {"metal", {0.35, 0.38, 0.42}},          {"wood", {0.30, 0.17, 0.07}},
               {"marble", {0.60, 0.56, 0.50}},         {"asphalt_concrete", {0.05, 0.05, 0.055}},
               {"wet_ground", {0.08, 0.10, 0.06}},     {"medium_dry_ground", {0.13, 0.13, 0.08}},
               {"very_dry_ground", {0.25, 0.20, 0.12}}};
  if (material.vegetation) return {0.08, 0.32, 0.09, 0.4};
  for (const auto& entry : known)
    if (material.name == entry.name) return {entry.colour[0], entry.colour[1], entry.colour[2], 1.0};
  return {0.32, 0.32, 0.31, 1.0};  // the colour of concrete
}

// Returns the configuration's values of a vegetation law.
json law_of(const VegetationLaw& vegetation) {
  json law{{"vegetation", vegetation.deciduous ? "deciduous" : "mixed"}, {"in_leaf", vegetation.in_leaf}};
  if (vegetation.attenuation_db_m) law["attenuation_db_m"] = *vegetation.attenuation_db_m;
  if (const auto most_db = vegetation.max_attenuation_db)
    law["max_attenuation_db"] = std::isfinite(*most_db) ? json(*most_db) : json("inf");
  return law;
}

}  // namespace

GlbFile::GlbFile() : json_{{"asset", {{"version", "2.0"}, {"generator", "wavetracer"}}}, {"scene", 0}} {}

size_t GlbFile::add(const char* array, json element) {
  json& list = json_[array];
  list.push_back(std::move(element));
  return list.size() - 1;
}

// All elements are 4, 12 or 16 bytes long, so every array begins at a multiple of 4.
size_t GlbFile::add_accessor(std::span<const std::byte> bytes, size_t count, const char* type, int component,
                             int target) {
  json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return add("accessors", {{"bufferView", add("bufferViews", std::move(view))},
                           {"componentType", component},
                           {"count", count},
                           {"type", type}});
}

template <class Values>
void GlbFile::set_bounds(size_t accessor, const Values& values, size_t components) {
  std::vector<float> lower(components, std::numeric_limits<float>::infinity()), upper(components, -lower[0]);
  const float* value = reinterpret_cast<const float*>(values.data());
  for (size_t i = 0; i < values.size() * components; ++i) {
    lower[i % components] = std::min(lower[i % components], value[i]);
    upper[i % components] = std::max(upper[i % components], value[i]);
  }
  json_["accessors"][accessor]["min"] = lower;
  json_["accessors"][accessor]["max"] = upper;
}

size_t GlbFile::add_positions(const std::vector<glm::vec3>& values) {
  const size_t accessor = add_accessor(std::as_bytes(std::span(values)), values.size(), "VEC3", floating, array_buffer);
  set_bounds(accessor, values, 3);
  return accessor;
}

size_t GlbFile::add_colours(const std::vector<Colour>& values) {
  const size_t accessor =
      add_accessor(std::as_bytes(std::span(values)), values.size(), "VEC4", unsigned_byte, array_buffer);
  json_["accessors"][accessor]["normalized"] = true;
  return accessor;
}

size_t GlbFile::add_indices(const std::vector<uint32_t>& values) {
  return add_accessor(std::as_bytes(std::span(values)), values.size(), "SCALAR", unsigned_int, element_array_buffer);
}

size_t GlbFile::add_times(const std::vector<float>& values) {
  const size_t accessor = add_accessor(std::as_bytes(std::span(values)), values.size(), "SCALAR", floating, 0);
  set_bounds(accessor, values, 1);
  return accessor;
}

size_t GlbFile::add_translations(const std::vector<glm::vec3>& values) {
  return add_accessor(std::as_bytes(std::span(values)), values.size(), "VEC3", floating, 0);
}

size_t GlbFile::add_rotations(const std::vector<glm::vec4>& values) {
  return add_accessor(std::as_bytes(std::span(values)), values.size(), "VEC4", floating, 0);
}

void GlbFile::write(const std::filesystem::path& path) {
  if (!buffer_.empty()) json_["buffers"] = json::array({{{"byteLength", buffer_.size()}}});
  std::string text = json_.dump(-1, ' ', false, json::error_handler_t::replace);
  text.append((4 - text.size() % 4) % 4, ' ');
  const size_t size = 12 + 8 + text.size() + (buffer_.empty() ? 0 : 8 + buffer_.size());
  if (size > std::numeric_limits<uint32_t>::max())
    throw RuntimeError(
        fmt::format("{}: would be {:.1f} GiB, and a .glb file holds 4 at most; convert fewer frames, or to vtk, "
                    "which has no such limit",
                    path.string(), static_cast<double>(size) * 0x1p-30));
  PendingFile file(path);
  const auto words = [&file](std::array<uint32_t, 2> values) { file.write(std::as_bytes(std::span(values))); };
  const auto bytes = [&file](const std::string& values) { file.write(std::as_bytes(std::span(values))); };
  bytes("glTF");
  words({2, static_cast<uint32_t>(size)});
  words({static_cast<uint32_t>(text.size()), 0x4E4F534A});  // JSON
  bytes(text);
  if (!buffer_.empty()) {
    words({static_cast<uint32_t>(buffer_.size()), 0x004E4942});  // BIN
    bytes(buffer_);
  }
  file.sync();
  file.commit();
}

namespace {

json law_of_surface(const Material& material) {
  json law{{"a", material.a}, {"b", material.b}, {"c", material.c}, {"d", material.d}};
  if (std::isfinite(material.thickness_m)) law["thickness_m"] = material.thickness_m;
  return law;
}

json law_of_wall(const Material& material) {
  json layers = json::array();
  for (const Material& layer : material.layers) {
    layers.push_back(law_of_surface(layer));
    layers.back()["name"] = layer.name;
  }
  return {{"layers", std::move(layers)}};
}

}  // namespace

json glb_material(const Material& material) {
  json law = material.layers.empty() ? law_of_surface(material) : law_of_wall(material);
  if (material.vegetation) law = law_of(*material.vegetation);
  if (material.scattering > 0) law["scattering"] = material.scattering;
  json element{{"name", material.name},
               {"doubleSided", true},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", base_colour(material)}, {"metallicFactor", 0}, {"roughnessFactor", 0.9}}},
               {"extras", std::move(law)}};
  if (material.vegetation) element["alphaMode"] = "BLEND";
  return element;
}

}  // namespace wavetracer
