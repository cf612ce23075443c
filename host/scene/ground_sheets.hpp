// SPDX-License-Identifier: Apache-2.0
// Sheets of surfaces that touch along edges, such as a ground of many triangles, and the rim of a ground. Up is z.
#pragma once
#include <cstdint>
#include <vector>

#include "base/forest.hpp"
#include "scene/triangle_grid.hpp"
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

// Finds free edges that are the rim of a ground, at the border of the map. The scene is a part of the world: the real
// ground continues beyond the rim, so the rim does not diffract. Names of objects do not matter. The rule: a free edge
// is the rim of a ground if all of this holds:
//
// 1. Its face is flatter than 45 degrees.
// 2. Somewhere along the edge nothing of the scene lies below it. So the rims of a table, a canopy, a bridge or a
//   carport over a ground do not count.
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
