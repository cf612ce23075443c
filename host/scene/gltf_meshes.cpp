// SPDX-License-Identifier: Apache-2.0
// See glTF 2.0, sections 3.7.2 (meshes), 3.7.3 (skins) and 3.7.2.2 (morph targets).
#include "scene/gltf_meshes.hpp"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/json_whole.hpp"

namespace wavetracer {
namespace {

using nlohmann::json;

enum Mode : int64_t { triangles = 4, strip = 5, fan = 6 };
constexpr const char* draco_extension = "KHR_draco_mesh_compression";
constexpr uint32_t unused_vertex = std::numeric_limits<uint32_t>::max();

// Returns the triangles of a list of corners; left-over corners at the end are ignored.
std::vector<Triangle> triangles_of(const std::vector<uint32_t>& corners, int64_t mode) {
  std::vector<Triangle> out;
  const size_t step = mode == Mode::triangles ? 3 : 1;
  for (size_t i = 0; i + 3 <= corners.size(); i += step) {
    const uint32_t first = corners[mode == Mode::fan ? 0 : i];
    const bool turned = mode == Mode::strip && i % 2 == 1;
    out.push_back({first, corners[i + (turned ? 2 : 1)], corners[i + (turned ? 1 : 2)]});
  }
  return out;
}

// Keeps the vertices that triangles use: meshes often share one long list.
void drop_unused(std::vector<glm::dvec3>& vertices, std::vector<Triangle>& triangles) {
  std::vector<uint32_t> moved(vertices.size(), unused_vertex);
  size_t used = 0;
  for (const Triangle& t : triangles)
    for (const uint32_t v : t)
      if (std::exchange(moved[v], 0) == unused_vertex) ++used;
  if (used == vertices.size()) return;
  std::ranges::fill(moved, unused_vertex);
  std::vector<glm::dvec3> kept;
  for (Triangle& t : triangles)
    for (uint32_t& v : t) {
      if (moved[v] == unused_vertex) {
        moved[v] = static_cast<uint32_t>(kept.size());
        kept.push_back(vertices[v]);
      }
      v = moved[v];
    }
  vertices = std::move(kept);
}

// A mesh that KHR_draco_mesh_compression compressed, decoded by Google's library (draco 1.5): it has points, and
// attributes that points are mapped to.
class DracoMesh {
 public:
  // Throws std::invalid_argument with the library's message if the bytes are no mesh.
  explicit DracoMesh(std::string_view bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) throw std::invalid_argument(mesh.status().error_msg_string());
    mesh_ = std::move(mesh).value();
  }

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> out;
    out.reserve(mesh_->num_faces());
    for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f) {
      const draco::Mesh::Face& face = mesh_->face(f);
      out.push_back({face[0].value(), face[1].value(), face[2].value()});
    }
    return out;
  }

  // Returns the numbers of the attribute with this id; nothing if there is none with this number of components.
  std::optional<std::vector<double>> numbers(uint32_t id, size_t components) const {
    const draco::PointAttribute* const attribute = mesh_->GetAttributeByUniqueId(id);
    if (attribute == nullptr || static_cast<size_t>(attribute->num_components()) != components) return std::nullopt;
    std::vector<double> out;
    out.reserve(mesh_->num_points() * components);
    double value[16] = {};
    for (draco::PointIndex p(0); p < mesh_->num_points(); ++p) {
      const draco::AttributeValueIndex at = attribute->mapped_index(p);
      if (at.value() >= attribute->size() || !attribute->ConvertValue<double>(at, value)) return std::nullopt;
      out.insert(out.end(), value, value + components);
    }
    return out;
  }

 private:
  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace

double GltfPlace::largest_stretch() const {
  double out = joints.empty() ? wavetracer::largest_stretch(world) : 0;
  for (const glm::dmat4& joint : joints) out = std::max(out, wavetracer::largest_stretch(joint));
  return out;
}

struct GltfMeshes::Primitive {
  std::unique_ptr<DracoMesh> draco = {};  // holds the attributes if they are compressed
  std::vector<double> positions = {};
  std::vector<Triangle> triangles = {};
  std::vector<glm::dvec3> vertices = {};  // positions after the transform

  size_t count() const { return positions.size() / 3; }
  double reach() const {
    double out = 0;
    for (const double x : positions) out = std::max(out, std::abs(x));
    return out;
  }
};

std::vector<double> GltfMeshes::attribute(const json& from, const char* name, size_t components, const Primitive& of) {
  if (of.draco) {
    const json& ids = from.at("extensions").at(draco_extension).at("attributes");
    if (ids.contains(name)) {
      if (auto out = of.draco->numbers(whole_at<uint32_t>(ids, name, draco_extension), components))
        return *std::move(out);
      data_.fail(fmt::format("the compressed mesh has no {} of {} components", name, components));
    }
  }
  return data_.numbers(from.at("attributes").at(name), components);
}

void GltfMeshes::read_draco(const json& from, const json& extension, Primitive& to) {
  try {
    to.draco = std::make_unique<DracoMesh>(data_.view(extension.at("bufferView")));
  } catch (const std::invalid_argument& error) {
    data_.fail(fmt::format("a mesh compressed by {} cannot be read: {}", draco_extension, error.what()));
  }
  to.positions = attribute(from, "POSITION", 3, to);
  to.triangles = to.draco->triangles();
}

void GltfMeshes::read_indices(const json& from, int64_t mode, Primitive& to) {
  std::vector<uint32_t> corners;
  if (from.contains("indices")) {
    for (const double index : data_.numbers(from["indices"], 1)) {
      if (!(index >= 0 && index < static_cast<double>(to.count())))
        data_.fail(fmt::format("vertex index {} is out of range, the mesh has {} vertices", index, to.count()));
      corners.push_back(static_cast<uint32_t>(index));
    }
  } else {
    for (uint32_t i = 0; i < to.count(); ++i) corners.push_back(i);
  }
  to.triangles = triangles_of(corners, mode);
}

bool GltfMeshes::read_primitive(const json& from, Primitive& to) {
  const auto mode = whole_or<int64_t>(from, "mode", Mode::triangles, "a mesh");
  if (mode < 0 || mode > Mode::fan) data_.fail(fmt::format("a mesh has the mode {}, which glTF does not know", mode));
  const json& attributes = from.at("attributes");
  if (mode < Mode::triangles || !attributes.contains("POSITION")) return false;
  if (from.contains("extensions") && from["extensions"].contains(draco_extension)) {
    read_draco(from, from["extensions"][draco_extension], to);
  } else {
    to.positions = attribute(from, "POSITION", 3, to);
    if (to.count() >= unused_vertex) data_.fail("a mesh has too many vertices for 32-bit indices");
    read_indices(from, mode, to);
  }
  largest_ = std::max(largest_, to.reach());
  for (const Triangle& t : to.triangles)
    for (const uint32_t v : t)
      if (v >= to.count())
        data_.fail(fmt::format("vertex index {} is out of range, the mesh has {} vertices", v, to.count()));
  return true;
}

void GltfMeshes::morph(const json& from, const std::vector<double>& weights, Primitive& to) {
  if (!from.contains("targets")) return;
  const json& targets = from["targets"];
  for (size_t k = 0; k < targets.size() && k < weights.size(); ++k) {
    if (weights[k] == 0 || !targets[k].contains("POSITION")) continue;
    const std::vector<double> moved = data_.numbers(targets[k]["POSITION"], 3);
    if (moved.size() != to.positions.size()) data_.fail("a morph target has not as many vertices as its mesh");
    for (size_t i = 0; i < moved.size(); ++i) to.positions[i] += weights[k] * moved[i];
  }
}

// A skin replaces the node's own transform (section 3.7.3.3): its joints share every vertex by weight.
void GltfMeshes::place(const json& from, const GltfPlace& by, Primitive& to) {
  const size_t count = to.count();
  std::vector<glm::dmat4> matrix(1, by.world);
  if (!by.joints.empty()) {
    matrix.assign(count, glm::dmat4(0));
    for (int set = 0; from.at("attributes").contains(fmt::format("JOINTS_{}", set)); ++set) {
      const std::vector<double> joint = attribute(from, fmt::format("JOINTS_{}", set).c_str(), 4, to),
                                weight = attribute(from, fmt::format("WEIGHTS_{}", set).c_str(), 4, to);
      if (joint.size() != 4 * count || weight.size() != 4 * count)
        data_.fail("a skin has not as many joints as its mesh has vertices");
      for (size_t i = 0; i < joint.size(); ++i) {
        if (weight[i] == 0) continue;
        if (!(joint[i] >= 0 && joint[i] < static_cast<double>(by.joints.size())))
          data_.fail(fmt::format("joint {} is out of range, the skin has {}", joint[i], by.joints.size()));
        matrix[i / 4] += weight[i] * by.joints[static_cast<size_t>(joint[i])];
      }
    }
  }
  to.vertices.reserve(count);
  for (size_t v = 0; v < count; ++v) {
    const glm::dvec4 p = matrix[by.joints.empty() ? 0 : v] *
                         glm::dvec4(to.positions[3 * v], to.positions[3 * v + 1], to.positions[3 * v + 2], 1);
    // Weights sum to one, up to rounding.
    to.vertices.push_back(by.joints.empty() ? glm::dvec3(p) : glm::dvec3(p) / p.w);
    if (const glm::dvec3& q = to.vertices.back(); !std::isfinite(q.x + q.y + q.z))
      data_.fail(fmt::format("vertex {} is not finite", v));
  }
}

std::vector<RawMesh> GltfMeshes::read(const json& mesh, const GltfPlace& by) {
  std::vector<double> weights = by.morph_weights;
  if (weights.empty() && mesh.contains("weights")) weights = mesh["weights"].get<std::vector<double>>();
  std::vector<RawMesh> out;
  for (const json& from : mesh.at("primitives")) {
    Primitive primitive;
    if (!read_primitive(from, primitive)) {
      ++not_surfaces_;
      continue;
    }
    morph(from, weights, primitive);
    place(from, by, primitive);
    drop_unused(primitive.vertices, primitive.triangles);
    RawMesh& added = out.emplace_back();
    added.where = file_.path.string();
    added.rounding = float32_rounding(primitive.reach()) * by.largest_stretch();
    added.vertices = std::move(primitive.vertices);
    added.triangles = std::move(primitive.triangles);
    if (from.contains("material")) {
      data_.item("materials", from["material"]);
      added.material = whole_at<uint32_t>(from, "material", "a mesh");
    }
  }
  return out;
}

}  // namespace wavetracer
