// SPDX-License-Identifier: Apache-2.0
// Reads GLB: glTF 2.0, section 4.4. Version 1 has its JSON in the same place, and refers to nodes by name where version
// 2 uses numbers. Names of extensions are those of https://github.com/KhronosGroup/glTF/tree/main/extensions, as of
// 2025.
#include "scene/gltf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using nlohmann::json;

constexpr int most_nested = 100;      // nested arrays and objects; glTF needs about ten
constexpr size_t most_levels = 1000;  // levels of nodes; assimp and model.cpp visit them by recursion

// Returns the length of the chunk whose header begins at this byte, or nothing if the file ends before.
std::optional<uint64_t> chunk_length(std::ifstream& in, uint64_t at) {
  std::array<char, 8> header{};
  if (!in.seekg(static_cast<std::streamoff>(at)).read(header.data(), header.size())) return {};
  uint64_t out = 0;
  for (size_t k = 4; k-- > 0;) out = out << 8 | static_cast<unsigned char>(header[k]);
  return out;
}

struct Chunks {
  std::string json, binary;
};

Chunks glb_chunks(std::ifstream& in, const std::filesystem::path& path) {
  const uint64_t size = std::filesystem::file_size(path);
  Chunks out;
  uint64_t at = 12;
  for (const bool first : {true, false}) {  // JSON comes first, then binary data; further chunks are skipped
    const std::optional<uint64_t> length = chunk_length(in, at);
    if (!length) break;
    at += 8;
    if (*length > size - at) {
      throw InputError(fmt::format(
          "{}: a chunk of {} bytes begins at byte {} of {}: the file is incomplete or damaged; copy it again",
          path.string(), *length, at, size));
    }
    std::string& text = first ? out.json : out.binary;
    text.resize(*length);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    at += (*length + 3) / 4 * 4;
  }
  out.json.resize(out.json.find_last_not_of('\0') + 1);  // some writers fill the chunk up with zeros
  return out;
}

// Returns how deep brackets are nested outside of strings. (A parser callback could tell, but would make parsing take
// quadratic time.)
int nesting(std::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\') {
      ++i;  // skips the escaped character
    } else if (c == '"') {
      in_string = !in_string;
    } else if (!in_string && (c == '[' || c == '{')) {
      deepest = std::max(deepest, ++depth);
    } else if (!in_string && (c == ']' || c == '}')) {
      --depth;
    }
  }
  return deepest;
}

json parse(std::string_view text, const std::string& file) {
  if (nesting(text) > most_nested)
    throw InputError(fmt::format("{}: its JSON is nested deeper than {} levels", file, most_nested));
  json out = json::parse(text, nullptr, false);
  if (!out.is_object()) throw InputError(fmt::format("{}: is not a glTF file: its JSON cannot be read", file));
  return out;
}

std::string name_of(const json& node) {
  return node.is_string() ? node.get<std::string>() : std::to_string(node.get<uint64_t>());
}

using Parents = std::map<std::string, std::string>;  // parent of each node, by name

void check_levels(const Parents& parents, const std::string& file) {
  std::map<std::string_view, size_t> levels;
  for (const auto& [node, parent] : parents) {
    std::vector<std::string_view> chain;  // path from the node up to one whose level is known, or to the root
    size_t level = 0;
    for (auto at = parents.find(node); at != parents.end() && level == 0; at = parents.find(at->second)) {
      if (const auto known = levels.find(at->first); known != levels.end()) {
        level = known->second;
      } else {
        chain.push_back(at->first);
      }
      if (chain.size() > most_levels) break;  // a longer chain is a circle of nodes or nests too deeply
    }
    if (level + chain.size() > most_levels) {
      throw InputError(fmt::format("{}: there are more than {} nodes one below the other", file, most_levels));
    }
    for (size_t k = chain.size(); k-- > 0;) levels[chain[k]] = ++level;
  }
}

// Adds the nodes that a list names; none of them may be there already.
void add_once(Parents& parents, const json& owner, const char* list, const std::string& parent,
              const std::string& file) {
  if (!owner.is_object() || !owner.contains(list)) return;
  for (const json& node : owner[list]) {
    if (!node.is_number_unsigned() && !node.is_string()) continue;  // assimp refuses these
    if (!parents.emplace(name_of(node), parent).second) {
      throw InputError(fmt::format(
          "{}: a node of '{}' has two parents; export the scene as a tree, with copies of nodes", file, parent));
    }
  }
}

// Extensions that GltfMeshes and GltfReader read; KHR_binary_glTF is the container of version 1.
constexpr std::array<std::string_view, 5> read_ones = {"EXT_mesh_gpu_instancing", "KHR_mesh_quantization",
                                                       "KHR_draco_mesh_compression", "KHR_node_visibility",
                                                       "KHR_binary_glTF"};

// Extensions about light, textures, sound, metadata and user interaction, which change no geometry. The entries are
// beginnings of names.
constexpr std::array<std::string_view, 37> harmless_extensions = {"KHR_materials_",
                                                                  "KHR_texture_",
                                                                  "KHR_lights_",
                                                                  "KHR_xmp",
                                                                  "KHR_animation_pointer",
                                                                  "KHR_audio_",
                                                                  "KHR_node_selectability",
                                                                  "KHR_node_hoverability",
                                                                  "KHR_interactivity",
                                                                  "KHR_techniques_webgl",
                                                                  "KHR_implicit_shapes",
                                                                  "KHR_physics_rigid_bodies",
                                                                  "KHR_accessor_float64_metadata",
                                                                  "EXT_texture_",
                                                                  "EXT_lights_",
                                                                  "EXT_mesh_features",
                                                                  "EXT_instance_features",
                                                                  "EXT_structural_metadata",
                                                                  "EXT_feature_metadata",
                                                                  "EXT_mesh_manifold",
                                                                  "EXT_property_",
                                                                  "MSFT_texture_dds",
                                                                  "MSFT_lod",
                                                                  "MSFT_packing_",
                                                                  "MSFT_audio_",
                                                                  "MSFT_collision_mesh",
                                                                  "MSFT_physics",
                                                                  "ADOBE_materials_",
                                                                  "AGI_articulations",
                                                                  "AGI_stk_metadata",
                                                                  "CESIUM_primitive_outline",
                                                                  "FB_geometry_metadata",
                                                                  "FB_ngon_encoding",
                                                                  "GRIFFEL_bim_data",
                                                                  "NV_materials_mdl",
                                                                  "WEB3D_",
                                                                  "VRM"};

bool is_known(std::string_view name) {
  return std::ranges::find(read_ones, name) != read_ones.end() ||
         std::ranges::any_of(harmless_extensions,
                             [&](std::string_view beginning) { return name.starts_with(beginning); });
}

// Returns advice about an extension that is required and not read.
std::string advice_for(std::string_view name) {
  if (name.find("meshopt") != std::string_view::npos) return "export it without compression";
  if (name == "CESIUM_RTC") return "convert it with its centre applied to the nodes";
  if (name == "KHR_gaussian_splatting") return "a cloud of splats has no surfaces: export a mesh";
  return "export it without that extension, or as OBJ or PLY";
}

std::vector<std::string> names_of(const GltfFile& file, const char* list) {
  std::vector<std::string> out;
  if (!file.document.contains(list)) return out;
  for (const auto& name : file.document[list])
    if (name.is_string()) out.push_back(name.get<std::string>());
  return out;
}

}  // namespace

GltfFile read_gltf_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 4> magic{};
  GltfFile out{.path = path, .document = {}, .binary = {}};
  out.is_glb = in.read(magic.data(), magic.size()) && std::string_view(magic.data(), magic.size()) == "glTF";
  Chunks chunks = out.is_glb ? glb_chunks(in, path) : Chunks{read_file(path), ""};
  out.binary = std::move(chunks.binary);
  out.document = parse(chunks.json, path.string());
  const json& document = out.document;
  Parents parents;
  if (document.contains("nodes")) {
    for (const auto& [name, node] : document["nodes"].items()) add_once(parents, node, "children", name, path.string());
  }
  check_levels(parents, path.string());
  if (document.contains("scenes")) {
    for (const auto& [name, scene] : document["scenes"].items()) {
      Parents roots;
      add_once(roots, scene, "nodes", name, path.string());
    }
  }
  return out;
}

std::vector<std::string> check_gltf_extensions(const GltfFile& file) {
  const std::vector<std::string> required = names_of(file, "extensionsRequired");
  for (const std::string& name : required)
    if (!is_known(name))
      throw InputError(fmt::format("{}: it requires the extension {}, which is not read: {}", file.path.string(), name,
                                   advice_for(name)));
  std::vector<std::string> out;
  for (const std::string& name : names_of(file, "extensionsUsed"))
    // If meshopt is not required, the file also holds the uncompressed data.
    if (!is_known(name) && name.find("meshopt") == std::string::npos)
      out.push_back(
          fmt::format("{}: it uses the extension {}, which is not known and was left out", file.path.string(), name));
  return out;
}

}  // namespace wavetracer
