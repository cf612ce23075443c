// SPDX-License-Identifier: Apache-2.0
// The sign of the volume of a closed part tells which side of its triangles is outside.
#include "scene/volumes.hpp"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <numeric>

#include "scene/volume_faces.hpp"
#include "scene/weld.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;

glm::dvec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

uint32_t root_of(std::vector<uint32_t>& parent, uint32_t vertex) {
  while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
  return vertex;
}

[[noreturn]] void fail_open(const RawMesh& mesh, const ClosedFaces& faces) {
  throw InputError(
      fmt::format("{}: mesh '{}' is vegetation, which must be a closed mesh, "
                  "but {} of its {} edges have no triangle on one side, or triangles that are turned differently: "
                  "close it, turn all of its triangles outwards, or give it another material",
                  mesh.where, mesh.name, faces.open_edges, faces.edges));
}

Volume volume_of(const std::vector<dvec3>& positions, const std::vector<Triangle>& triangles, uint32_t material) {
  Volume out{.shape = VolumeShape::mesh, .material = material};
  dvec3 lower = positions[triangles[0][0]], upper = lower;
  double six_volumes = 0;
  for (const Triangle& t : triangles) {
    const std::array<dvec3, 3> corners{positions[t[0]], positions[t[1]], positions[t[2]]};
    for (const dvec3& corner : corners) {
      lower = glm::min(lower, corner);
      upper = glm::max(upper, corner);
    }
    const dvec3& base = positions[triangles[0][0]];
    six_volumes += glm::dot(corners[0] - base, glm::cross(corners[1] - base, corners[2] - base));
    out.triangles.push_back(corners);
  }
  if (six_volumes < 0)
    for (auto& corners : out.triangles) std::swap(corners[1], corners[2]);
  out.centre = 0.5 * (lower + upper);
  out.half_size = 0.5 * (upper - lower);
  return out;
}

}  // namespace

void add_volumes(RawScene& raw, const std::vector<VegetationConfig>& vegetation) {
  for (const VegetationConfig& from : vegetation) {
    for (const double size_m : from.size_m)
      if (!(size_m > 0))
        throw ConfigError(fmt::format("[[vegetation]]: size_m = [{}, {}, {}], but all of it must be positive",
                                      from.size_m[0], from.size_m[1], from.size_m[2]));
    RawVolume out;
    out.volume.shape = static_cast<VolumeShape>(from.shape.index());
    out.volume.centre = vector_of(from.centre_m);
    out.volume.half_size = 0.5 * vector_of(from.size_m);
    out.volume.yaw_rad = from.yaw_deg * std::numbers::pi / 180;
    out.material = from.material;
    raw.volumes.push_back(std::move(out));
  }
}

std::vector<Volume> mesh_volumes(const RawMesh& mesh, uint32_t material, LoadReport* report) {
  const Weld weld = weld_vertices(mesh.vertices, weld_tolerance_m);
  std::vector<uint32_t> parent(weld.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<Triangle> triangles;
  for (const Triangle& t : mesh.triangles) {
    const Triangle welded{weld.vertex[t[0]], weld.vertex[t[1]], weld.vertex[t[2]]};
    if (welded[0] == welded[1] || welded[1] == welded[2] || welded[2] == welded[0]) continue;
    triangles.push_back(welded);
    for (int i = 1; i < 3; ++i) parent[root_of(parent, welded[i])] = root_of(parent, welded[0]);
  }
  std::map<uint32_t, std::vector<Triangle>> parts;
  for (const Triangle& t : triangles) parts[root_of(parent, t[0])].push_back(t);
  std::vector<Volume> out;
  ClosedFaces not_closed;
  for (const auto& [root, part] : parts) {
    const ClosedFaces faces = closed_faces(weld.positions, part);
    not_closed.edges += faces.edges;
    not_closed.open_edges += faces.open_edges;
    if (report != nullptr) report->duplicate_triangles += faces.repeated;
    if (!faces.triangles.empty()) out.push_back(volume_of(weld.positions, faces.triangles, material));
    if (faces.triangles.empty()) not_closed.triangles = part;
  }
  if (!not_closed.triangles.empty()) fail_open(mesh, not_closed);
  return out;
}

}  // namespace wavetracer
