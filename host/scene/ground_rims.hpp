// SPDX-License-Identifier: Apache-2.0
// Finds free edges that are the rim of a ground, at the border of the map. The scene is a part of the world: the real
// ground continues beyond the rim, so the rim does not diffract. Names of objects do not matter.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/surface_sheets.hpp"
#include "scene/triangle_grid.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Rule: a free edge is the rim of a ground if all of this holds:
//
// 1. Its face is flatter than 45 degrees.
// 2. Somewhere along the edge nothing of the scene lies below it. So the rims of a table, a canopy, a bridge or a
// carport
//   over a ground do not count.
// 3. Its face is joined, by way of surfaces that touch along edges, to so many that together they span at least half of
//   the scene, seen from above (half of the area of the box around it). So a canopy is not a ground if a scene has no
//   ground at all, and tiles of a ground that are not welded, or of several materials, are one.
//
// A closed slab has no free edges and is not a sheet. Up is z. Models of vehicles have no ground.
class GroundRims {
 public:
  // Joins surfaces that share edges of the mesh; the scene must outlive this object.
  explicit GroundRims(const Scene& scene);
  void join(uint32_t surface, uint32_t other);  // joins surfaces that touch along an edge without sharing it
  // Tells whether the wedge is the rim of a ground. All surfaces that touch must have been joined before.
  bool are_of(const Wedge& wedge, const TriangleGrid& triangles);

 private:
  const Scene& scene_;
  SurfaceSheets sheets_;
  std::vector<bool> wide_;  // for each sheet, once all are joined
};

}  // namespace wavetracer
