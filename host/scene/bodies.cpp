// SPDX-License-Identifier: Apache-2.0
// Triangles that share an edge are joined in a union-find forest; the lowest triangle of a set comes first.
// It assumes the edges of a built scene, whose faces are indices of its triangles.
#include "scene/bodies.hpp"

#include "base/forest.hpp"

namespace wavetracer {

std::vector<uint32_t> bodies_of(const Scene& scene) {
  Forest bodies(scene.triangles.size());
  for (const Edge& edge : scene.edges)
    for (uint32_t k = 1; k < edge.face_count; ++k)
      bodies.join(scene.edge_faces[edge.first_face], scene.edge_faces[edge.first_face + k]);
  std::vector<uint32_t> body(bodies.size());
  uint32_t count = 0;
  for (uint32_t t = 0; t < bodies.size(); ++t) {
    const uint32_t first = bodies.root(t);
    body[t] = first == t ? count++ : body[first];
  }
  return body;
}

}  // namespace wavetracer
