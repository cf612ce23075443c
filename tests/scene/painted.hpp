// SPDX-License-Identifier: Apache-2.0
// Meshes that have names of materials, and what lies where in scenes of them.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "scene/topology.hpp"
#include "wedge_check.hpp"

namespace wavetracer::test {

// A mesh and the name of its material.
struct Painted {
  RawMesh mesh;
  std::string material;
};

inline Scene build_painted(const std::vector<Painted>& parts, double scattering = 0) {
  RawScene raw;
  raw.file = "test";
  ResolvedMaterials resolved;
  for (const Painted& part : parts) {
    raw.meshes.push_back(part.mesh);
    const auto same = std::ranges::find(resolved.materials, part.material, &Material::name);
    resolved.mesh_material.push_back(static_cast<uint32_t>(same - resolved.materials.begin()));
    if (same != resolved.materials.end()) continue;
    Material material{.name = part.material, .scattering = scattering};
    if (part.material == "leaves") material.vegetation = VegetationLaw{};
    resolved.materials.push_back(material);
  }
  return build_scene(raw, std::move(resolved), EdgeSearch::of_model, 1e-3);
}

inline RawMesh turned_over(RawMesh in) {
  for (Triangle& t : in.triangles) std::swap(t[1], t[2]);
  return in;
}

// A rectangle of nu times nv cells, each with a diagonal.
inline RawMesh cells(dvec3 corner, dvec3 u, dvec3 v, uint32_t nu, uint32_t nv) {
  RawMesh out;
  for (uint32_t j = 0; j <= nv; ++j)
    for (uint32_t i = 0; i <= nu; ++i) out.vertices.push_back(corner + u * (1.0 * i / nu) + v * (1.0 * j / nv));
  for (uint32_t j = 0; j < nv; ++j)
    for (uint32_t i = 0; i < nu; ++i) {
      const uint32_t a = j * (nu + 1) + i, b = a + 1, c = a + nu + 1, d = c + 1;
      out.triangles.push_back({a, b, d});
      out.triangles.push_back({a, d, c});
    }
  return out;
}

inline double area_m2(const Scene& s, const std::string& material) {
  double sum = 0;
  for (uint32_t t = 0; t < s.triangles.size(); ++t)
    if (s.materials[s.surfaces[s.triangle_surface[t]].material].name == material) sum += triangle_shape(s, t).area_m2;
  return sum;
}

// The materials of all triangles within 1 um of a point of the file.
inline std::vector<std::string> materials_at(const Scene& s, const dvec3& p) {
  std::vector<std::string> out;
  for (uint32_t t = 0; t < s.triangles.size(); ++t) {
    const auto& [a, b, c] = s.triangles[t];
    if (distance_m(p - s.origin_m, {s.vertices[a], s.vertices[b], s.vertices[c]}) > 1e-6) continue;
    out.push_back(s.materials[s.surfaces[s.triangle_surface[t]].material].name);
  }
  return out;
}

inline bool holds(const RawMesh& part, const dvec3& p) {
  return std::ranges::any_of(part.triangles, [&](const Triangle& t) {
    return distance_m(p, {part.vertices[t[0]], part.vertices[t[1]], part.vertices[t[2]]}) <= 1e-9;
  });
}

}  // namespace wavetracer::test
