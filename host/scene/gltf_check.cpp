// GLB: glTF 2.0, section 4.4. Version 1 has its JSON in the same place, and names nodes where version 2 counts them.
// Only the JSON is read, of GLB files not the binary data.
#include "scene/gltf_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using nlohmann::json;

// The length of the chunk whose header begins at this byte; empty where the file ends before.
std::optional<uint64_t> chunk_length(std::ifstream& in, uint64_t at) {
  std::array<char, 8> header{};
  if (!in.seekg(static_cast<std::streamoff>(at)).read(header.data(), header.size())) return {};
  uint64_t out = 0;
  for (size_t k = 4; k-- > 0;) out = out << 8 | static_cast<unsigned char>(header[k]);
  return out;
}

std::string glb_json(std::ifstream& in, const std::filesystem::path& path) {
  const uint64_t size = std::filesystem::file_size(path);
  std::string out;
  uint64_t at = 12;
  for (const bool first : {true, false}) {  // JSON, then binary data; further chunks are passed over
    const std::optional<uint64_t> length = chunk_length(in, at);
    if (!length) break;
    at += 8;
    if (*length > size - at) {
      throw InputError(fmt::format("{}: a chunk of {} bytes begins at byte {} of {}: the file is cut short or damaged; "
                                   "copy it again",
                                   path.string(), *length, at, size));
    }
    if (first) {
      out.resize(*length);
      in.read(out.data(), static_cast<std::streamsize>(out.size()));
    }
    at += (*length + 3) / 4 * 4;
  }
  out.resize(out.find_last_not_of('\0') + 1);  // some writers fill the chunk up with zeros
  return out;
}

// Of the values that children or nodes name, none may be there twice.
void add_once(std::set<json>& seen, const json& owner, const char* key, const std::string& file) {
  if (!owner.is_object() || !owner.contains(key)) return;
  for (const json& node : owner[key]) {
    if (!node.is_number() && !node.is_string()) continue;
    if (!seen.insert(node).second) {
      throw InputError(fmt::format("{}: the node {} has two parents; export the scene as a tree, with copies of nodes",
                                   file, node.dump(-1, ' ', true, json::error_handler_t::replace)));
    }
  }
}

}  // namespace

void check_gltf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string begin(4096, '\0');
  begin.resize(static_cast<size_t>(in.read(begin.data(), static_cast<std::streamsize>(begin.size())).gcount()));
  const bool glb = begin.starts_with("glTF");
  const size_t text = begin.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (!glb && (text == begin.npos || begin[text] != '{')) return;  // OBJ
  in.clear();
  in.seekg(0);
  const json document = glb ? json::parse(glb_json(in, path), nullptr, false) : json::parse(in, nullptr, false);
  if (!document.is_object()) throw InputError(fmt::format("{}: is no glTF: its JSON cannot be read", path.string()));
  std::set<json> children;
  if (document.contains("nodes")) {
    for (const json& node : document["nodes"]) add_once(children, node, "children", path.string());
  }
  if (document.contains("scenes")) {
    for (const json& scene : document["scenes"]) {
      std::set<json> roots;
      add_once(roots, scene, "nodes", path.string());
    }
  }
}

}  // namespace wavetracer
