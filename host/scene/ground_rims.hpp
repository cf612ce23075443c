// Which free edges are the rim of a ground: the border of the map. The real ground continues there, so it does not
// diffract. A scene is a part of the world, and its ground a sheet that ends at the border of the map. Names do not
// matter.
#pragma once
#include <cstdint>
#include <vector>

#include "scene/surface_sheets.hpp"
#include "scene/triangle_grid.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// The rule. A free edge is the rim of a ground if all of this holds:
//
// 1. Its face is flatter than 45 degrees.
// 2. Somewhere along the edge nothing of the scene lies below it: so the rims of a table, a canopy, a bridge or a
// carport
//    over a ground are none.
// 3. Its face is joined, by way of surfaces that touch along edges, to so many that together they span at least half of
//    the scene, seen from above (half of the area of the box around it). So a canopy is not a ground if a scene has no
//    ground at all, and tiles of a ground that are not welded, or of several materials, are one.
//
// A closed slab has no free edges and is not a sheet. Up is z. Models of vehicles have no ground.
class GroundRims {
 public:
  explicit GroundRims(const Scene& scene);      // joins surfaces that share edges of the mesh; scene outlives this
  void join(uint32_t surface, uint32_t other);  // surfaces that touch along an edge without sharing it
  // Whether the wedge is the rim of a ground; after all that touches was joined.
  bool are_of(const Wedge& wedge, const TriangleGrid& triangles);

 private:
  const Scene& scene_;
  SurfaceSheets sheets_;
  std::vector<bool> wide_;  // of sheets, once all are joined
};

}  // namespace wavetracer
