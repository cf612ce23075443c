// SPDX-License-Identifier: Apache-2.0
// A glTF 2.0 file for tests, put together from its parts: GLB after section 4.4 of the specification.
#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "scene/model.hpp"
#include "scene_files.hpp"

namespace wavetracer::test {

using nlohmann::json;

// A document whose accessors are made of numbers: indices are those of glTF.
struct Gltf {
  json document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", json::array({{{"nodes", {0}}}})}};
  std::string data;

  size_t add(const char* list, json entry) {
    document[list].push_back(std::move(entry));
    return document[list].size() - 1;
  }
  size_t view(const std::string& bytes, size_t stride = 0) {
    json entry = {{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) entry["byteStride"] = stride;
    data += bytes;
    while (data.size() % 4 != 0) data.push_back('\0');
    return add("bufferViews", entry);
  }
  // T: the component type of the file.
  template <class T>
  size_t accessor(const std::vector<T>& numbers, const char* type, size_t components, bool normalized = false) {
    std::string bytes;
    for (const T number : numbers) bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    const int component = std::is_same_v<T, float>      ? 5126
                          : std::is_same_v<T, int8_t>   ? 5120
                          : std::is_same_v<T, uint8_t>  ? 5121
                          : std::is_same_v<T, int16_t>  ? 5122
                          : std::is_same_v<T, uint16_t> ? 5123
                                                        : 5125;
    return add("accessors", {{"bufferView", view(bytes)},
                             {"componentType", component},
                             {"count", numbers.size() / components},
                             {"type", type},
                             {"normalized", normalized}});
  }
  size_t positions(const std::vector<float>& numbers) { return accessor(numbers, "VEC3", 3); }
  // A mesh of one primitive, and a node with it.
  void mesh(json primitive, json node = json::object()) {
    node["mesh"] = add("meshes", {{"primitives", json::array({std::move(primitive)})}});
    add("nodes", std::move(node));
  }
  void require(const char* extension) {
    document["extensionsUsed"].push_back(extension);
    document["extensionsRequired"].push_back(extension);
  }

  std::string glb() const {
    json all = document;
    all["buffers"] = json::array({{{"byteLength", data.size()}}});
    std::string text = all.dump();
    while (text.size() % 4 != 0) text += ' ';
    const auto number = [](size_t n) {
      const auto bits = static_cast<uint32_t>(n);
      return std::string(reinterpret_cast<const char*>(&bits), 4);
    };
    return "glTF" + number(2) + number(28 + text.size() + data.size()) + number(text.size()) + "JSON" + text +
           number(data.size()) + std::string("BIN\0", 4) + data;
  }
  RawScene read() const {
    const TemporaryFolder folder;
    return read_model(folder.write("a.glb", glb()), ModelFormat::gltf);
  }
};

}  // namespace wavetracer::test
