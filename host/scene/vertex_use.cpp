// SPDX-License-Identifier: Apache-2.0
#include "scene/vertex_use.hpp"

namespace wavetracer {

std::vector<uint32_t> drop_unused_vertices(Scene& scene) {
  constexpr uint32_t unused = 0xFFFFFFFFu;
  std::vector<uint32_t> moved(scene.vertices.size(), unused), former;
  for (const auto& t : scene.triangles) {
    for (const uint32_t v : t) moved[v] = 0;
  }
  for (uint32_t v = 0; v < moved.size(); ++v) {
    if (moved[v] == unused) continue;
    moved[v] = static_cast<uint32_t>(former.size());
    scene.vertices[former.size()] = scene.vertices[v];
    former.push_back(v);
  }
  scene.vertices.resize(former.size());
  for (auto& t : scene.triangles) {
    for (uint32_t& v : t) v = moved[v];
  }
  return former;
}

}  // namespace wavetracer
