// SPDX-License-Identifier: Apache-2.0
// Nodes are visited depth first, parents before children. A mesh of several primitives becomes several meshes, and so
// do instances (EXT_mesh_gpu_instancing).
#include "scene/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <set>

#include "base/json_whole.hpp"
#include "scene/gltf_data.hpp"
#include "scene/gltf_file.hpp"
#include "scene/gltf_meshes.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using nlohmann::json;

constexpr uint64_t most_copied_vertices = 50'000'000;

// Returns the name of an entry of a list, or a name such as "nodes_3" if it has none.
std::string name_in(const json& entry, const char* list, size_t index) {
  const std::string name = entry.value("name", std::string());
  return name.empty() ? fmt::format("{}_{}", list, index) : name;
}

template <size_t N>
std::array<double, N> numbers_in(const json& node, const char* key, std::array<double, N> absent) {
  return node.contains(key) ? node[key].get<std::array<double, N>>() : absent;
}

const json& empty_list() {
  static const json empty = json::array();
  return empty;
}

const json& list_in(const json& entry, const char* key) { return entry.contains(key) ? entry[key] : empty_list(); }

// Returns an object below "extensions", or null if it is missing.
const json* extension_of(const json& entry, const char* name) {
  const auto extensions = entry.find("extensions");
  if (extensions == entry.end() || !extensions->contains(name)) return nullptr;
  return &(*extensions)[name];
}

class GltfReader {
 public:
  explicit GltfReader(const GltfFile& file)
      : file_(file), document_(file.document), data_(file), meshes_(file, data_), nodes_(list_in(document_, "nodes")) {
    raw_.file = file.path.string();
    raw_.files = {raw_.file};
  }

  RawScene read() {
    for (const char* key : {"minVersion", "version"})
      if (const json& asset = document_.value("asset", json::object());
          asset.contains(key) && !asset[key].get<std::string>().starts_with("2"))
        data_.fail(fmt::format("its {} is {}, but glTF 2.0 and 1.0 are read", key, asset[key].dump()));
    raw_.warnings = check_gltf_extensions(file_);
    const json& materials = list_in(document_, "materials");
    for (size_t i = 0; i < materials.size(); ++i)
      raw_.materials.push_back({name_in(materials[i], "materials", i), raw_.file, {}, {}, {}, {}});
    find_places();
    const std::vector<size_t> roots = roots_of_scene();
    for (const size_t root : roots) visit(root);
    warn_of_rest();
    raw_.files.insert(raw_.files.end(), data_.files().begin(), data_.files().end());
    return std::move(raw_);
  }

 private:
  size_t node_at(const json& index) const {
    data_.item("nodes", index);
    return index.get<size_t>();
  }

  static glm::dmat4 turned_and_scaled(glm::dvec3 move, const std::array<double, 4>& q, glm::dvec3 scale) {
    const glm::dquat turn(q[3], q[0], q[1], q[2]);
    return glm::translate(glm::dmat4(1), move) * glm::mat4_cast(glm::normalize(turn)) *
           glm::scale(glm::dmat4(1), scale);
  }

  glm::dmat4 own_transform(const json& node, size_t index) const {
    if (node.contains("matrix")) {
      const auto m = numbers_in<16>(node, "matrix", {});
      if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        data_.fail(fmt::format("the matrix of node '{}' must end in the row 0 0 0 1", name_in(node, "nodes", index)));
      return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]};
    }
    const auto t = numbers_in<3>(node, "translation", {0, 0, 0}), s = numbers_in<3>(node, "scale", {1, 1, 1});
    const auto q = numbers_in<4>(node, "rotation", {0, 0, 0, 1});
    if (q == std::array<double, 4>{})
      data_.fail(fmt::format("the rotation of node '{}' is four zeros", name_in(node, "nodes", index)));
    return turned_and_scaled({t[0], t[1], t[2]}, q, {s[0], s[1], s[2]});
  }

  // Finds the transforms of all nodes to the frame of the file, since the joints of a skin may be anywhere.
  void find_places() {
    world_.assign(nodes_.size(), glm::dmat4(1));
    parented_.assign(nodes_.size(), false);
    for (const json& node : nodes_)
      for (const json& child : list_in(node, "children")) parented_[node_at(child)] = true;
    for (size_t i = 0; i < nodes_.size(); ++i)
      if (!parented_[i]) find_places_below(i, glm::dmat4(1));
  }

  void find_places_below(size_t index, const glm::dmat4& parent) {
    world_[index] = parent * own_transform(nodes_[index], index);
    for (const json& child : list_in(nodes_[index], "children")) find_places_below(node_at(child), world_[index]);
  }

  // Returns the roots of the default scene, of the first scene if no default is named, and all nodes if there is no
  // scene.
  std::vector<size_t> roots_of_scene() {
    const json& scenes = list_in(document_, "scenes");
    std::vector<size_t> out;
    if (scenes.empty()) {
      for (size_t i = 0; i < nodes_.size(); ++i)
        if (!parented_[i]) out.push_back(i);
      return out;
    }
    const auto scene = whole_or<size_t>(document_, "scene", 0);
    for (const json& root : list_in(data_.item("scenes", json(scene)), "nodes")) {
      out.push_back(node_at(root));
      if (parented_[out.back()])
        data_.fail(fmt::format("node '{}' is a root of its scene, and the child of another node",
                               name_in(nodes_[out.back()], "nodes", out.back())));
    }
    if (scenes.size() > 1)
      raw_.warnings.push_back(fmt::format("{}: of its {} scenes only '{}' is read", raw_.file, scenes.size(),
                                          name_in(scenes[scene], "scenes", scene)));
    return out;
  }

  void visit(size_t index) {
    const json& node = nodes_[index];
    if (const json* visibility = extension_of(node, "KHR_node_visibility");
        visibility != nullptr && !visibility->value("visible", true)) {
      ++hidden_nodes_;
      return;
    }
    const std::string name = name_in(node, "nodes", index);
    const glm::dvec3 origin(world_[index][3]);
    if (std::isfinite(origin.x + origin.y + origin.z)) raw_.nodes.push_back({name, origin});
    if (node.contains("mesh")) add_mesh(node, index, name);
    for (const json& child : list_in(node, "children")) visit(node_at(child));
  }

  void add_mesh(const json& node, size_t index, const std::string& name) {
    const json& mesh = data_.item("meshes", node["mesh"]);
    GltfPlace place{.world = world_[index]};
    if (node.contains("weights")) place.morph_weights = node["weights"].get<std::vector<double>>();
    if (node.contains("skin")) place.joints = joints_of(node["skin"]);
    meshes_seen_ += 1;
    if (const json* instancing = extension_of(node, "EXT_mesh_gpu_instancing")) {
      for (const glm::dmat4& instance : instances_of(*instancing)) {
        place.world = world_[index] * instance;
        add(mesh, place, name);
      }
      return;
    }
    add(mesh, place, name);
  }

  void add(const json& from, const GltfPlace& place, const std::string& name) {
    std::vector<RawMesh> meshes = meshes_.read(from, place);
    // A short file can name one mesh very often: the file's length bounds the data, but not the copies of it.
    if (!used_.insert(&from).second)
      for (const RawMesh& mesh : meshes) copied_vertices_ += mesh.vertices.size() + 1;
    if (copied_vertices_ > most_copied_vertices)
      data_.fail(fmt::format("the copies of its meshes, in nodes and instances, have more than {} vertices",
                             most_copied_vertices));
    for (RawMesh& mesh : meshes) {
      mesh.name = name;
      raw_.meshes.push_back(std::move(mesh));
    }
  }

  std::vector<glm::dmat4> joints_of(const json& index) {
    const json& skin = data_.item("skins", index);
    const json& joints = skin.at("joints");
    std::vector<double> inverse;
    if (skin.contains("inverseBindMatrices")) inverse = data_.numbers(skin["inverseBindMatrices"], 16);
    if (!inverse.empty() && inverse.size() < 16 * joints.size())
      data_.fail(fmt::format("skin {} has fewer inverse bind matrices than joints", index.dump()));
    std::vector<glm::dmat4> out;
    for (size_t k = 0; k < joints.size(); ++k) {
      glm::dmat4 bind(1);
      if (!inverse.empty())
        for (int column = 0; column < 4; ++column)
          for (int row = 0; row < 4; ++row) bind[column][row] = inverse[16 * k + static_cast<size_t>(4 * column + row)];
      out.push_back(world_[node_at(joints[k])] * bind);
    }
    return out;
  }

  std::vector<glm::dmat4> instances_of(const json& extension) {
    const json& attributes = extension.at("attributes");
    const auto read = [&](const char* key, size_t components) {
      return attributes.contains(key) ? data_.numbers(attributes[key], components) : std::vector<double>{};
    };
    const std::vector<double> move = read("TRANSLATION", 3), turn = read("ROTATION", 4), scale = read("SCALE", 3);
    const size_t count = std::max({move.size() / 3, turn.size() / 4, scale.size() / 3});
    const auto fits = [&](const std::vector<double>& list, size_t components) {
      return list.empty() || list.size() == components * count;
    };
    if (!fits(move, 3) || !fits(turn, 4) || !fits(scale, 3))
      data_.fail("the attributes of EXT_mesh_gpu_instancing have different counts");
    std::vector<glm::dmat4> out;
    for (size_t i = 0; i < count; ++i) {
      const auto vector = [i](const std::vector<double>& list, double absent) {
        return list.empty() ? glm::dvec3(absent) : glm::dvec3(list[3 * i], list[3 * i + 1], list[3 * i + 2]);
      };
      std::array<double, 4> q{0, 0, 0, 1};
      if (!turn.empty()) std::copy_n(turn.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, q.begin());
      if (q == std::array<double, 4>{}) data_.fail("a rotation of EXT_mesh_gpu_instancing is four zeros");
      out.push_back(turned_and_scaled(vector(move, 0), q, vector(scale, 1)));
    }
    return out;
  }

  void warn(uint64_t count, const char* what) {
    if (count > 0) raw_.warnings.push_back(fmt::format("{}: {} {}", raw_.file, count, what));
  }

  void warn_of_rest() {
    uint64_t nodes_with_meshes = 0;
    for (const json& node : nodes_) nodes_with_meshes += node.contains("mesh");
    warn(hidden_nodes_, "nodes are hidden, and were left out with what is below them");
    if (hidden_nodes_ == 0)
      warn(nodes_with_meshes - meshes_seen_, "nodes with meshes are not in the scene, and were left out");
    if (const double spacing = meshes_.largest_coordinate() * 0x1p-23; spacing > 1e-3)
      raw_.warnings.push_back(
          fmt::format("{}: coordinates of its meshes reach {:.0f}, where float32 keeps only {:.3g}: "
                      "move the meshes to their origin and their nodes away from it",
                      raw_.file, meshes_.largest_coordinate(), spacing));
    warn(meshes_.not_surfaces(), "meshes of points or lines were left out");
    warn(list_in(document_, "animations").size(), "animations are not played: all nodes stay where the file has them");
  }

  const GltfFile& file_;
  const json& document_;
  GltfData data_;
  GltfMeshes meshes_;
  const json& nodes_;
  RawScene raw_;
  std::vector<glm::dmat4> world_;
  std::vector<bool> parented_;
  uint64_t meshes_seen_ = 0, hidden_nodes_ = 0, copied_vertices_ = 0;
  std::set<const json*> used_;  // the meshes that were used
};

}  // namespace

RawScene read_gltf(const GltfFile& file) {
  try {
    return GltfReader(file).read();
  } catch (const json::exception& error) {
    throw InputError(fmt::format("{}: its JSON is not what glTF 2.0 prescribes: {}", file.path.string(), error.what()));
  }
}

}  // namespace wavetracer
