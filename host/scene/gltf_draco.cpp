// SPDX-License-Identifier: Apache-2.0
// draco 1.5: a decoded mesh has points, and attributes that points are mapped to.
#include "scene/gltf_draco.hpp"

#include <draco/compression/decode.h>

#include <memory>
#include <stdexcept>

namespace wavetracer {

struct DracoMesh::Decoded {
  std::unique_ptr<draco::Mesh> mesh;
};

DracoMesh::DracoMesh(std::string_view bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) throw std::invalid_argument(mesh.status().error_msg_string());
  decoded_ = new Decoded{std::move(mesh).value()};
}

DracoMesh::~DracoMesh() { delete decoded_; }

std::vector<std::array<uint32_t, 3>> DracoMesh::triangles() const {
  const draco::Mesh& mesh = *decoded_->mesh;
  std::vector<std::array<uint32_t, 3>> out;
  out.reserve(mesh.num_faces());
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh.face(f);
    out.push_back({face[0].value(), face[1].value(), face[2].value()});
  }
  return out;
}

std::optional<std::vector<double>> DracoMesh::numbers(uint32_t id, size_t components) const {
  const draco::Mesh& mesh = *decoded_->mesh;
  const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(id);
  if (attribute == nullptr || static_cast<size_t>(attribute->num_components()) != components) return std::nullopt;
  std::vector<double> out;
  out.reserve(mesh.num_points() * components);
  double value[16] = {};
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
    const draco::AttributeValueIndex at = attribute->mapped_index(p);
    if (at.value() >= attribute->size() || !attribute->ConvertValue<double>(at, value)) return std::nullopt;
    out.insert(out.end(), value, value + components);
  }
  return out;
}

}  // namespace wavetracer
