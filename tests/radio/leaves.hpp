// SPDX-License-Identifier: Apache-2.0
// Volumes of vegetation for tests, and the length of a leg inside of all of them.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "radio/vegetation_law.hpp"
#include "scene/volumes.hpp"
#include "wavetracer/device/volumes.h"

namespace wavetracer::test {

inline double inside_m(const VolumeTable& table, const glm::dvec3& from, const glm::dvec3& to) {
  double out = 0;
  for (uint32_t k = 0; k < table.volumes.size(); ++k) out += device::wt_length_in_space(table.all(), k, from, to);
  return out;
}

inline VolumeTable table_of(std::vector<Volume> volumes) {
  Scene scene;
  scene.volumes = std::move(volumes);
  return volume_table(scene);
}

inline Volume shaped(VolumeShape shape, const glm::dvec3& centre, const glm::dvec3& half, double yaw_rad = 0) {
  Volume out;
  out.shape = shape;
  out.centre = centre;
  out.half_size = half;
  out.yaw_rad = yaw_rad;
  return out;
}

// The box of a volume as a mesh, twelve triangles.
inline RawMesh box_mesh(const Volume& box, bool inside_out = false) {
  RawMesh mesh{"hedge", "hedge.ply", {}, {}, 0};
  const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
  for (uint32_t corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p = box.half_size * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    mesh.vertices.push_back(box.centre + glm::dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z));
  }
  for (const auto& [a, b, e, f] : std::vector<std::array<uint32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    mesh.triangles.push_back({a, b, e});
    mesh.triangles.push_back({a, e, f});
  }
  if (inside_out)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline bool is_inside(const Volume& v, const glm::dvec3& p) {
  const double c = std::cos(v.yaw_rad), s = std::sin(v.yaw_rad);
  const glm::dvec3 d = p - v.centre, q = glm::dvec3(c * d.x + s * d.y, c * d.y - s * d.x, d.z) / v.half_size;
  if (v.shape == VolumeShape::spheroid) return glm::dot(q, q) <= 1;
  if (v.shape == VolumeShape::cylinder) return q.x * q.x + q.y * q.y <= 1 && std::abs(q.z) <= 1;
  return std::abs(q.x) <= 1 && std::abs(q.y) <= 1 && std::abs(q.z) <= 1;
}

}  // namespace wavetracer::test
