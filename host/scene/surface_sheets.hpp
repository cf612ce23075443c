// SPDX-License-Identifier: Apache-2.0
// Sheets: sets of surfaces that touch along edges, such as a ground of many triangles. Up is z.
#pragma once
#include <cstdint>
#include <vector>

#include "base/forest.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

class SurfaceSheets {
 public:
  // Joins surfaces that share edges of the mesh; flat_alone: only those for which is_flat() holds. The scene must
  // outlive this object.
  explicit SurfaceSheets(const Scene& scene, bool flat_alone = false);
  void join(uint32_t surface, uint32_t other) { sheets_.join(surface, other); }
  // Returns the surface that represents the sheet of this one.
  uint32_t root(uint32_t surface) { return sheets_.root(surface); }
  // For each surface that represents a sheet, tells whether the sheet spans at least half of the scene seen from above
  // (half of the area of its bounding box).
  std::vector<bool> wide();

 private:
  const Scene& scene_;
  Forest sheets_;  // nodes are surfaces
};

// Tells whether the surface is flatter than 45 degrees.
bool is_flat(const Surface& surface);

// Returns the number of surfaces of a scene's ground: the largest sheet of surfaces flatter than 45 degrees that spans
// half of the scene. It is 1 on a flat ground, thousands on a terrain, 0 if there is no ground. It needs scene.edges.
size_t ground_surfaces(const Scene& scene);

}  // namespace wavetracer
