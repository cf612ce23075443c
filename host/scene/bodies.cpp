// A forest of triangles, each pointing to a lower one; triangles that share an edge have one root.
// Assumes the edges of a scene that was built: faces are indices of its triangles.
#include "scene/bodies.hpp"

#include <algorithm>
#include <numeric>

namespace wavetracer {

std::vector<uint32_t> bodies_of(const Scene& scene) {
  std::vector<uint32_t> parent(scene.triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (const Edge& edge : scene.edges)
    for (uint32_t k = 1; k < edge.face_count; ++k) {
      const uint32_t a = root(scene.edge_faces[edge.first_face]), b = root(scene.edge_faces[edge.first_face + k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<uint32_t> body(parent.size());
  uint32_t count = 0;
  for (uint32_t t = 0; t < parent.size(); ++t) {
    const uint32_t first = root(t);
    body[t] = first == t ? count++ : body[first];
  }
  return body;
}

}  // namespace wavetracer
